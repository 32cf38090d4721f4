// The bits of health by name: those that are raised now, and those that were since the start.

// What every gyro in order says now and then.
const in_order = new Set(["switching", "warming_up", "edges_shifted", "recentring"]);

export class HealthList {
    private shown = "";

    constructor(
        private readonly place: HTMLElement,
        private readonly names: string[],
    ) {}

    show(now: number, since_start: number): void {
        const key = `${now} ${since_start}`;
        if (key === this.shown) return;
        this.shown = key;
        const raised = this.names.map((name, bit) => ({ name, bit })).filter(({ bit }) => ((since_start >>> bit) & 1) === 1);
        this.place.replaceChildren(...raised.map(({ name, bit }) => this.item(name, ((now >>> bit) & 1) === 1)));
        if (raised.length === 0) this.place.append(this.good());
    }

    private item(name: string, now: boolean): HTMLElement {
        const item = document.createElement("li");
        const text = name.replaceAll("_", " ");
        item.textContent = now ? `${text}: now` : text;
        item.className = now && !in_order.has(name) ? "now" : "";
        item.title = now ? "raised now" : "was raised since the start";
        return item;
    }

    private good(): HTMLElement {
        const item = document.createElement("li");
        item.textContent = "nothing to report";
        item.className = "good";
        return item;
    }
}

// The bits of health by name: those that are raised now, and those that were since the start.
import { made } from "./elements";

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
        if (raised.length === 0) this.place.append(made("li", "nothing to report", { class: "good" }));
    }

    private item(name: string, now: boolean): HTMLElement {
        const text = name.replaceAll("_", " ");
        const known = { class: now && !in_order.has(name) ? "now" : "", title: now ? "raised now" : "was raised since the start" };
        return made("li", now ? `${text}: now` : text, known);
    }
}

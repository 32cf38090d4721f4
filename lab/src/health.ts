// The bits of health by name: those that are raised now, those that were since the start, and what a fault has raised.
import { element, made } from "./elements";

// What every gyro in order says now and then, and what it says while it switches.
const in_order = new Set(["switching", "warming_up", "edges_shifted", "recentring"]);
const in_a_switch = new Set(["light_lost", "detuning_over_limit"]);

const readable = (name: string) => name.replaceAll("_", " ");

export class HealthList {
    private shown = "";
    private since_fault: Set<string> | null = null; // null: there was none

    constructor(
        private readonly place: HTMLElement,
        private readonly names: string[],
    ) {}

    // From now on what is raised is told below the buttons, too.
    expect_fault(): void {
        this.since_fault = new Set();
        this.tell_fault();
    }

    show(now: number, since_start: number): void {
        const key = `${now} ${since_start}`;
        if (key === this.shown) return;
        this.shown = key;
        const raised_now = new Set(this.names_in(now));
        const is_usual = (name: string) => in_order.has(name) || (raised_now.has("switching") && in_a_switch.has(name));
        const raised = this.names_in(since_start);
        this.place.replaceChildren(...raised.map((name) => item(name, raised_now.has(name), is_usual(name))));
        if (raised.length === 0) this.place.append(made("li", "nothing to report", { class: "good" }));
        if (this.since_fault === null) return;
        for (const name of raised_now) if (!is_usual(name)) this.since_fault.add(name);
        this.tell_fault();
    }

    private tell_fault(): void {
        const names = [...(this.since_fault ?? [])].map(readable);
        element("fault-report").textContent = `Reported since the last fault: ${names.length > 0 ? names.join(", ") : "nothing yet"}.`;
    }

    private names_in(bits: number): string[] {
        return this.names.filter((_, bit) => ((bits >>> bit) & 1) === 1);
    }
}

function item(name: string, now: boolean, usual: boolean): HTMLElement {
    const kind = now && !usual ? "now" : in_order.has(name) || in_a_switch.has(name) ? "usual" : "";
    return made("li", now ? `${readable(name)}: now` : readable(name), { class: kind, title: now ? "raised now" : "was raised since the start" });
}

// The bits of health by name: those that are raised now, those that were since the start, and what a fault has raised.
import { made } from "./elements";
import type { Raised } from "./protocol";

// What every gyro in order says now and then, and what it says while it switches.
const in_order = new Set(["switching", "warming_up", "edges_shifted", "recentring"]);
const in_a_switch = new Set(["light_lost", "detuning_over_limit"]);

const readable = (name: string) => name.replaceAll("_", " ");

export class HealthList {
    private shown = "";

    constructor(
        private readonly place: HTMLElement,
        private readonly names: string[],
    ) {}

    show(now: number, since_start: Raised): void {
        const key = `${now} ${since_start.settled} ${since_start.switching}`;
        if (key === this.shown) return;
        this.shown = key;
        const raised_now = new Set(this.names_in(now));
        const in_trouble = new Set(this.unusual(since_start));
        const switches = raised_now.has("switching");
        const is_usual_now = (name: string) => in_order.has(name) || (switches && in_a_switch.has(name));
        const items = this.names_in(since_start.settled | since_start.switching).map((name) => item(name, raised_now.has(name), raised_now.has(name) ? is_usual_now(name) : !in_trouble.has(name)));
        this.place.replaceChildren(...items);
        if (items.length === 0) this.place.append(made("li", "nothing to report", { class: "good" }));
    }

    // In words: what a gyro in order does not say.
    report(raised: Raised): string {
        return this.unusual(raised).map(readable).join(", ");
    }

    private unusual({ settled, switching }: Raised): string[] {
        const in_no_switch = new Set(this.names_in(settled));
        return this.names_in(settled | switching).filter((name) => !in_order.has(name) && (in_no_switch.has(name) || !in_a_switch.has(name)));
    }

    private names_in(bits: number): string[] {
        return this.names.filter((_, bit) => ((bits >>> bit) & 1) === 1);
    }
}

function item(name: string, now: boolean, usual: boolean): HTMLElement {
    const kind = usual ? "usual" : now ? "now" : "";
    return made("li", now ? `${readable(name)}: now` : readable(name), { class: kind, title: now ? "raised now" : "was raised since the start" });
}

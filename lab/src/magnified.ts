// Switches, magnified: one large, and the last few small beside each other, of which a click brings one up.
import { element, finite, made, part } from "./elements";
import { Chart, short } from "./plots";
import type { SwitchPicture } from "./protocol";

const kept = 8;
const [width, height] = [116, 56]; // of a small one

export class MagnifiedSwitches {
    private readonly chart: Chart;
    private readonly strip: HTMLElement;
    private pictures: SwitchPicture[] = [];
    private chosen: number | null = null; // first tick; null: the last

    // name  of the chart's place `plot-NAME`, the strip's `NAME-strip` and the text's `NAME-text`.
    // cost  what a picture's cost_arcsec is, in words.
    constructor(
        private readonly name: string,
        private readonly cost: string,
        has_truth: boolean,
    ) {
        const points = { unit: "arcsec/s", points: true };
        // In this order none is hidden: what is read leaves the others in the gap alone.
        const lines = [{ label: "read from the counter", colour: "--read", ...points }, { label: "interpolated", colour: "--ours", ...points }, { label: "extrapolated", colour: "--paper", dash: [4, 3], ...points }, { label: "true", colour: "--true", unit: "arcsec/s" }];
        this.has_truth = has_truth;
        this.chart = new Chart(element(`plot-${name}`), { x: "ticks since the loop was opened", y: "rate, arcsec/s", height: 240, lines: has_truth ? lines : lines.slice(0, 3) });
        this.strip = element(`${name}-strip`);
    }

    private readonly has_truth: boolean;

    begin(text: string): void {
        this.pictures = [];
        this.chosen = null;
        this.chart.show(this.has_truth ? [[], [], [], [], []] : [[], [], [], []]);
        this.strip.replaceChildren();
        element(`${this.name}-text`).textContent = text;
    }

    add(more: SwitchPicture[]): void {
        if (more.length === 0) return;
        const news = new Set(more.map((picture) => picture.first_tick));
        this.pictures = [...this.pictures.filter((picture) => !news.has(picture.first_tick)), ...more].slice(-kept);
        if (!this.pictures.some((picture) => picture.first_tick === this.chosen)) this.chosen = null;
        this.draw();
    }

    private draw(): void {
        const shown = this.pictures.find((picture) => picture.first_tick === this.chosen) ?? this.pictures.at(-1)!;
        const [ticks, truth, read, extrapolated, interpolated] = shown.columns;
        this.chart.show([ticks, read, interpolated, extrapolated, ...(this.has_truth ? [truth] : [])].map((column, at) => (at === 0 ? Array.from(column) : Array.from(column, finite))));
        element(`${this.name}-text`).textContent = `At ${short(shown.at_s, 6)} s the loop was open for ${shown.gap_ticks} ticks (${short(shown.gap_s * 1000)} ms) and caught mode ${shown.mode_after > 0 ? "+1" : "−1"}. ${this.cost}: ${short(shown.cost_arcsec, 3)} arcsec.`;
        const focused = this.strip.contains(document.activeElement) ? (document.activeElement as HTMLElement).dataset.tick : undefined;
        this.strip.replaceChildren(...this.pictures.map((picture) => this.small(picture, picture === shown)));
        this.strip.querySelector<HTMLElement>(`[data-tick="${focused}"]`)?.focus({ preventScroll: true });
    }

    // The chosen one stays until it has left the strip; the last one goes on to be the last.
    private small(picture: SwitchPicture, shown: boolean): HTMLElement {
        const name = `Switch at ${short(picture.at_s, 6)} s, ${short(picture.cost_arcsec, 2)} arcsec`;
        const button = made("button", "", { type: "button", "data-tick": String(picture.first_tick), "aria-pressed": String(shown), "aria-label": name });
        button.append(drawing(picture, this.has_truth), made("span", `${short(picture.at_s, 6)} s`), made("span", `${short(picture.cost_arcsec, 2)}″`));
        button.addEventListener("click", () => {
            this.chosen = picture === this.pictures.at(-1) ? null : picture.first_tick;
            this.draw();
        });
        return button;
    }
}

// The gap shaded; the true and the interpolated rate where there are both, what was read clipped to the height.
function drawing(picture: SwitchPicture, has_truth: boolean): SVGElement {
    const [ticks, truth, read, , final] = picture.columns;
    const scale = Array.from(has_truth ? truth : read).filter((value, row) => Number.isFinite(value) && (has_truth || ticks[row] < 0 || ticks[row] >= picture.gap_ticks));
    const [least, most] = [Math.min(...scale), Math.max(...scale)];
    const margin = 0.15 * (most - least) + 1;
    const x = (tick: number) => ((tick - ticks[0]) / (ticks[ticks.length - 1] - ticks[0] || 1)) * width;
    const y = (rate: number) => Math.min(Math.max(height - ((rate - least + margin) / (most - least + 2 * margin)) * height, -4), height + 4);
    const whole = part(null, "svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
    part(whole, "rect", { x: x(0).toFixed(1), y: 0, width: Math.max(x(picture.gap_ticks) - x(0), 2).toFixed(1), height, class: "gap" });
    for (const [values, colour] of [[read, "read"], ...(has_truth ? [[truth, "true"]] : []), [final, "ours"]] as [Float64Array, string][]) {
        const points = Array.from(values, (rate, row) => (Number.isFinite(rate) ? `${x(ticks[row]).toFixed(1)},${y(rate).toFixed(1)}` : "")).filter((point) => point !== "");
        part(whole, "polyline", { points: points.join(" "), class: colour });
    }
    return whole;
}

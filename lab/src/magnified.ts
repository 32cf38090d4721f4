// The last switch, magnified.
import { element, finite } from "./elements";
import { Chart, short } from "./plots";
import type { SwitchPicture } from "./protocol";

export class MagnifiedSwitch {
    private readonly chart: Chart;

    // name  of the chart's place `plot-NAME` and the text's `NAME-text`.
    // cost  what a picture's cost_arcsec is, in words.
    constructor(
        private readonly name: string,
        private readonly cost: string,
        private readonly has_truth: boolean,
    ) {
        const points = { unit: "arcsec/s", points: true };
        // In this order none is hidden: what is read leaves the others in the gap alone.
        const lines = [{ label: "read from the counter", colour: "--read", ...points }, { label: "interpolated", colour: "--ours", ...points }, { label: "extrapolated", colour: "--paper", dash: [4, 3], ...points }, { label: "true", colour: "--true", unit: "arcsec/s" }];
        this.chart = new Chart(element(`plot-${name}`), { x: "ticks since the loop was opened", y: "rate, arcsec/s", height: 240, lines: has_truth ? lines : lines.slice(0, 3) });
    }

    begin(text: string): void {
        this.chart.show(this.has_truth ? [[], [], [], [], []] : [[], [], [], []]);
        element(`${this.name}-text`).textContent = text;
    }

    show(picture: SwitchPicture): void {
        const [ticks, truth, read, extrapolated, interpolated] = picture.columns;
        const drawn = [read, interpolated, extrapolated, ...(this.has_truth ? [truth] : [])];
        this.chart.show([ticks, ...drawn.map((column) => Array.from(column, finite))]);
        element(`${this.name}-text`).textContent = `At ${short(picture.at_s, 6)} s the loop was open for ${picture.gap_ticks} ticks (${short(picture.gap_s * 1000)} ms) and caught mode ${picture.mode_after > 0 ? "+1" : "−1"}. ${this.cost}: ${short(picture.cost_arcsec, 3)} arcsec.`;
    }
}

// The theory beside the gyro that runs: what it costs to switch often or seldom.
import { element, positive } from "./elements";
import { Chart, type Line, short } from "./plots";
import type { Columns, Design } from "./protocol";

const fewest_switches = 5; // whose rms is taken for what a switch leaves

const this_gyro = { label: "this gyro", colour: "--true", only_points: true };

// "10 min", "1.5 h"
function duration(seconds: number): string {
    const [length, unit] = seconds >= 2 * 86400 ? [86400, "d"] : seconds >= 3600 ? [3600, "h"] : seconds >= 60 ? [60, "min"] : [1, "s"];
    return `${short(seconds / length, 3)} ${unit}`;
}

function drift_lines(run_s: number): Line[] {
    const unit = "deg/h";
    const [sixth, whole, ten] = [run_s / 6, run_s, 10 * run_s].map(duration);
    return [{ label: sixth, colour: "--other", unit }, { label: whole, colour: "--ours", unit }, { label: ten, colour: "--paper", unit }, { label: `${whole}, the paper’s law (7)`, colour: "--ours", unit, dash: [2, 3] }, { label: `${whole}, at its worst end`, colour: "--read", unit, dash: [5, 4] }, { ...this_gyro, unit }];
}

export class DesignView {
    private readonly drift = new Chart(element("plot-design"), { x: "switching interval, s", y: "drift, deg/h", height: 250, log_x: true, log_y: true, lines: drift_lines(3600) });
    private readonly interval = new Chart(element("plot-best"), { x: "length of the run, s", y: "best interval, s", height: 250, log_x: true, log_y: true, lines: [{ label: "least expected drift", colour: "--ours", unit: "s" }, { label: "the paper’s √(dP t/Ω)", colour: "--paper", unit: "s", dash: [5, 4] }, { ...this_gyro, unit: "s" }] });
    private error_arcsec: number | null = null; // that was asked for last

    constructor(private readonly ask: (switch_error_arcsec: number | null) => void) {}

    // Of a new gyro nothing is measured.
    begin(): void {
        this.error_arcsec = null;
        this.ask(null);
    }

    // The rms error of the switches so far; of a gyro that runs, where it has changed enough to be seen in the charts.
    follow(n_switches: number, rms_arcsec: number, runs: boolean): void {
        if (n_switches < fewest_switches || !(rms_arcsec > 0)) return;
        if (this.error_arcsec !== null && Math.abs(rms_arcsec - this.error_arcsec) <= (runs ? 0.05 * this.error_arcsec : 0)) return;
        this.error_arcsec = rms_arcsec;
        this.ask(rms_arcsec);
    }

    show(design: Design): void {
        this.drift.name_lines(drift_lines(design.run_s));
        draw(this.drift, design.drift);
        draw(this.interval, design.interval);
        element("design-text").textContent = interval_text(design);
    }
}

function draw(chart: Chart, [x, ...columns]: Columns): void {
    chart.show([x, ...columns.map((column) => Array.from(column, positive))]);
}

function interval_text(design: Design): string {
    const run = duration(design.run_s);
    if (!Number.isFinite(design.best_s)) return "The theory does not cover a gyro with these settings.";
    const cost = `A switch leaves ${short(design.switch_error_arcsec, 3)} arcsec${design.is_measured ? "" : " (presumed)"}.`;
    const drift = `${short(design.best_drift_arcsec_s, 3)} deg/h`;
    const best = design.best_s < design.run_s ? `In a run of ${run} it is best to switch every ${short(design.best_s, 3)} s: ${drift} are to be expected.` : `In a run of ${run} no switch pays: ${drift} are to be expected without.`;
    const here = Number.isFinite(design.interval_s) ? `This gyro switches every ${short(design.interval_s)} s: ${short(design.drift_arcsec_s, 3)} deg/h.` : "This gyro chooses its intervals itself.";
    return `${cost} ${best} ${here}`;
}

// The theory beside the gyro that runs: what it costs to switch often or seldom, and to bridge a gap.
import { element, finite, positive } from "./elements";
import { Chart, type Line, short } from "./plots";
import type { Columns, Design } from "./protocol";

const fewest_switches = 5; // whose rms is taken for what a switch leaves

const this_gyro = { label: "this gyro", colour: "--true", only_points: true };

// "10 min", "1.5 h"
function duration(seconds: number): string {
    const [length, unit] = seconds >= 2 * 86400 ? [86400, "d"] : seconds >= 3600 ? [3600, "h"] : seconds >= 60 ? [60, "min"] : [1, "s"];
    return `${short(seconds / length, 3)} ${unit}`;
}

function gap_lines(): Line[] {
    const unit = "arcsec";
    const kinds: [string, number[] | undefined][] = [["interpolated", undefined], ["extrapolated", [5, 4]]];
    const orders: [string, string][] = [["constant", "--read"], ["line", "--paper"], ["parabola", "--ours"]];
    return [...kinds.flatMap(([kind, dash]) => orders.map(([order, colour]) => ({ label: `${kind}, ${order}`, colour, unit, dash }))), { ...this_gyro, unit }];
}

function drift_lines(run_s: number): Line[] {
    const unit = "deg/h";
    const [sixth, whole, ten] = [run_s / 6, run_s, 10 * run_s].map(duration);
    return [{ label: sixth, colour: "--other", unit }, { label: whole, colour: "--ours", unit }, { label: ten, colour: "--paper", unit }, { label: `${whole}, the paper’s law (7)`, colour: "--ours", unit, dash: [2, 3] }, { label: `${whole}, at its worst end`, colour: "--read", unit, dash: [5, 4] }, { ...this_gyro, unit }];
}

export class DesignView {
    private readonly drift = new Chart(element("plot-design"), { x: "switching interval, s", y: "drift, deg/h", height: 250, log_x: true, log_y: true, lines: drift_lines(3600) });
    private readonly interval = new Chart(element("plot-best"), { x: "length of the run, s", y: "best interval, s", height: 250, log_x: true, log_y: true, lines: [{ label: "least expected drift", colour: "--ours", unit: "s" }, { label: "the paper’s √(dP t/Ω)", colour: "--paper", unit: "s", dash: [5, 4] }, { ...this_gyro, unit: "s" }] });
    private readonly by_frequency = new Chart(element("plot-gap-frequency"), { x: "frequency of the motion, Hz", y: "error, arcsec", height: 250, lines: gap_lines() });
    private readonly by_amplitude = new Chart(element("plot-gap-amplitude"), { x: "amplitude of the rate, arcsec/s", y: "error, arcsec", height: 250, lines: gap_lines() });
    private readonly noise = new Chart(element("plot-gap-noise"), { x: "ticks of the gap", y: "3 sigma, arcsec", height: 250, log_y: true, lines: gap_lines() });
    private error_arcsec: number | null = null; // that was asked for last

    constructor(private readonly ask: (switch_error_arcsec: number | null, passes_zero: boolean) => void) {
        element("gap-phase").addEventListener("change", () => this.ask_again());
    }

    // Of a new gyro nothing is measured.
    begin(): void {
        this.error_arcsec = null;
        this.ask_again();
    }

    // The rms error of the switches so far; of a gyro that runs, where it has changed enough to be seen in the charts.
    follow(n_switches: number, rms_arcsec: number, runs: boolean): void {
        if (n_switches < fewest_switches || !(rms_arcsec > 0)) return;
        if (this.error_arcsec !== null && Math.abs(rms_arcsec - this.error_arcsec) <= (runs ? 0.05 * this.error_arcsec : 0)) return;
        this.error_arcsec = rms_arcsec;
        this.ask_again();
    }

    private ask_again(): void {
        this.ask(this.error_arcsec, element<HTMLSelectElement>("gap-phase").value === "zero");
    }

    show(design: Design): void {
        this.drift.name_lines(drift_lines(design.run_s));
        draw(this.drift, design.drift, positive);
        draw(this.interval, design.interval, positive);
        draw(this.by_frequency, design.by_frequency, finite);
        draw(this.by_amplitude, design.by_amplitude, finite);
        draw(this.noise, design.noise, positive);
        element("design-text").textContent = interval_text(design);
        element("gap-text").textContent = gap_text(design);
    }
}

function draw(chart: Chart, [x, ...columns]: Columns, drawn: (value: number) => number | null): void {
    chart.show([x, ...columns.map((column) => Array.from(column, drawn))]);
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

function gap_text(design: Design): string {
    const motion = `${short(design.amplitude_arcsec_s)} arcsec/s at ${short(design.frequency_hz)} Hz`;
    const [constant, , parabola, constant_ahead, , parabola_ahead] = design.error_arcsec.map((error) => short(error, 3));
    const [noise, , parabola_noise] = design.noise_arcsec.map((sigmas) => short(sigmas, 3));
    return `A gap of ${design.gap_ticks} ticks, bridged by the polynomials of the paper; ${design.oscillates ? `this case oscillates with ${motion}` : `this case does not oscillate: drawn for ${motion}`}. Interpolated, which stays in the angle, a constant misses by ${constant} arcsec, a parabola by ${parabola}; extrapolated, which is taken back, by ${constant_ahead} and ${parabola_ahead}. The rounding of the counter adds 3 sigma of ${noise} and ${parabola_noise} arcsec.`;
}

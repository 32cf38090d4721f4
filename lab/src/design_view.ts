// The theory beside the gyro that runs: its drift over the switching interval, with the interval at which it stands.
import { Chart, short } from "./plots";
import type { Columns } from "./protocol";

const run_s = 3600;
const default_error_arcsec = 10;
const fewest_switches = 5;
const default_interval_s = 90;

function element(id: string): HTMLElement {
    return document.getElementById(id)!;
}

// The column with one more row before `after`, on the straight line between its neighbours.
function with_point(x: Float64Array, column: Float64Array, after: number, at: number): number[] {
    const share = (at - x[after - 1]) / (x[after] - x[after - 1]);
    const value = column[after - 1] + share * (column[after] - column[after - 1]);
    return [...column.slice(0, after), value, ...column.slice(after)];
}

export class DesignView {
    private readonly chart: Chart;
    private interval_s = default_interval_s;
    private error_arcsec = 0; // that was asked for last

    constructor(private readonly ask: (switch_error_arcsec: number, run_s: number) => void) {
        const unit = "deg/h";
        this.chart = new Chart(element("plot-design"), {
            x: "switching interval, s", y: "drift, deg/h", height: 230, log_x: true, log_y: true,
            lines: [{ label: "eq (7)", colour: "--paper", unit }, { label: "at the worst end", colour: "--read", unit }, { label: "expected", colour: "--ours", unit }, { label: "this gyro", colour: "--true", unit, points: true }],
        });
    }

    begin(settings: string[]): void {
        const interval = settings.find((setting) => setting.startsWith("switching.interval_s="));
        this.interval_s = interval === undefined ? default_interval_s : Number(interval.split("=")[1]);
        this.error_arcsec = 0;
        this.follow(0, 0);
    }

    // The rms error of the switches so far.
    follow(n_switches: number, rms_arcsec: number): void {
        const error_arcsec = n_switches >= fewest_switches && rms_arcsec > 0 ? rms_arcsec : default_error_arcsec;
        if (Math.abs(error_arcsec - this.error_arcsec) < 0.05 * this.error_arcsec) return;
        this.error_arcsec = error_arcsec;
        this.ask(error_arcsec, run_s);
    }

    show(columns: Columns): void {
        element("card-design").hidden = columns.length === 0;
        if (columns.length === 0) return;
        const [interval, , , expected] = columns;
        const best = expected.reduce((least, value, at) => (value < expected[least] ? at : least), 0);
        const after = interval.findIndex((each) => each > this.interval_s);
        const drawn = after > 0 ? columns.map((column) => with_point(interval, column, after, this.interval_s)) : columns.map((column) => Array.from(column));
        const here = after > 0 ? drawn[3][after] : null;
        this.chart.show([...drawn, drawn[0].map((_, at) => (at === after ? here : null))]);
        const stands = here === null ? "" : ` This gyro switches every ${short(this.interval_s)} s: ${short(here, 3)} deg/h.`;
        element("design-text").textContent = `A run of an hour; a switch leaves ${short(this.error_arcsec, 3)} arcsec. Least drift to be expected: ${short(expected[best], 3)} deg/h, with a switch every ${short(interval[best], 2)} s.${stands}`;
    }
}

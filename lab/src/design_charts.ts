// The charts of the paper for the gyro that runs: figures 4 and 5, and where it stands in them.
import { Budget, IntervalLaw, type LoopModule } from "./loop_module";
import type { Columns, Design } from "./protocol";
import type { Settings } from "./settings";

const shortest_run_s = 3600;
type Mark = [x: number, y: number];
type Curve = (x: number) => number;

function log_spaced(from: number, to: number, n: number): number[] {
    return Array.from({ length: n }, (_, k) => from * (to / from) ** (k / (n - 1)));
}

// A row for each place of the grid and for each mark, in their order; the last column has the marks.
function table(grid: number[], curves: Curve[], marks: Mark[]): Columns {
    const rows = [...grid.map((x): Mark => [x, NaN]), ...marks].sort(([a], [b]) => a - b);
    const column = (of: (row: Mark) => number) => Float64Array.from(rows, of);
    return [column(([x]) => x), ...curves.map((curve) => column(([x]) => curve(x))), column(([, y]) => y)];
}

function marks_at(x: number, curves: Curve[]): Mark[] {
    return Number.isFinite(x) ? curves.map((curve) => [x, curve(x)]) : [];
}

// measured_arcsec  rms error that a switch leaves; null: it is not known.
export function design_of(module: LoopModule, settings: Settings, measured_arcsec: number | null): Design {
    const error_arcsec = measured_arcsec ?? settings.number("design.switch_error_arcsec");
    const fixed = settings.text("switching.schedule") === "fixed";
    const interval_s = fixed ? settings.number("switching.interval_s") : NaN;
    // At least as long as an interval: a shorter run has no switch.
    const run_s = Math.max(shortest_run_s, fixed ? interval_s : 0);
    const best = (law: IntervalLaw) => (length_s: number) => module.calls.zlg_interval(law, length_s, error_arcsec);
    const best_s = best(IntervalLaw.expected)(run_s);
    const drift = (budget: Budget, length_s: number) => (at_s: number) => module.calls.zlg_drift(budget, at_s, length_s, error_arcsec);
    const expected = [run_s / 6, run_s, 10 * run_s].map((length_s) => drift(Budget.expected, length_s));
    const places = [interval_s, best_s].filter(Number.isFinite);
    const least_s = Math.min(...places) / 20;
    const most_s = Math.min(20 * Math.max(...places), 10 * run_s);
    return {
        run_s,
        switch_error_arcsec: error_arcsec,
        is_measured: measured_arcsec !== null,
        interval_s,
        drift_arcsec_s: expected[1](interval_s),
        best_s,
        best_drift_arcsec_s: expected[1](best_s),
        drift: table(places.length > 0 ? log_spaced(least_s, most_s, 90) : [], [...expected, drift(Budget.as_printed, run_s), drift(Budget.worst_case, run_s)], marks_at(interval_s, expected)),
        interval: table(log_spaced(run_s / 30, 30 * run_s, 15), [best(IntervalLaw.expected), best(IntervalLaw.closed_form)], Number.isFinite(interval_s) ? [[run_s, interval_s]] : []),
    };
}

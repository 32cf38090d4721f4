// The charts of the paper for the gyro that runs: figures 4, 5 and 8 to 11, and where it stands in them.
import { type Bridge, response, rounding_arcsec } from "./gap_error";
import { Budget, IntervalLaw, type LoopModule } from "./loop_module";
import type { Columns, Design } from "./protocol";
import type { Settings } from "./settings";

const shortest_run_s = 3600;
// Where the case does not oscillate: the paper's example.
const example = { amplitude_arcsec_s: 12000, periods_a_tick: 0.1 };
const n_sigmas = 3;
const rounding = 1e-13; // a zero of theory is not to show that of its sines

type Mark = [x: number, y: number];
type Curve = (x: number) => number;

function log_spaced(from: number, to: number, n: number): number[] {
    return Array.from({ length: n }, (_, k) => from * (to / from) ** (k / (n - 1)));
}

function evenly(from: number, to: number, n: number): number[] {
    return Array.from({ length: n }, (_, k) => from + ((to - from) * k) / (n - 1));
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

function intervals(module: LoopModule, settings: Settings, measured_arcsec: number | null) {
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

// The interpolating bridges of orders 0, 1, 2, then the extrapolating ones.
function bridges(module: LoopModule, settings: Settings, gap_ticks: number): Bridge[] {
    const number = (key: string) => settings.number(`compensation.${key}`);
    const run = (from: number, count: number) => Array.from({ length: count }, (_, k) => from + k);
    const before = (count: number) => run(1 - count, count);
    const inside = [...before(number("points_before")), ...run(gap_ticks + 1, number("points_after"))];
    return [inside, before(number("extrapolation_points"))].flatMap((places, extrapolates) => [0, 1, 2].map((order) => ({ gap_ticks, places, weights: module.gap_weights(extrapolates === 1, order, gap_ticks, places.length) })));
}

// Of each oscillation of the motion: amplitude and frequency.
function oscillations(settings: Settings): [number, number][] {
    const kind = settings.text("motion.kind");
    if (kind !== "sine" && kind !== "sum") return [];
    const frequencies = settings.numbers("motion.frequency_hz");
    return settings.numbers("motion.amplitude_arcsec_s").map((amplitude, at): [number, number] => [Math.abs(amplitude), frequencies[at]]);
}

function gaps(module: LoopModule, settings: Settings, passes_zero: boolean) {
    const tick_s = settings.number("gyro.tick_s");
    const gap_ticks = settings.number("switching.gap_ticks");
    const count_arcsec = settings.number("gyro.scale_arcsec");
    const moves = oscillations(settings);
    const [amplitude_arcsec_s, frequency_hz] = [...moves].sort(([a], [b]) => b - a)[0] ?? [example.amplitude_arcsec_s, example.periods_a_tick / tick_s];
    const here = bridges(module, settings, gap_ticks);
    const error = (bridge: Bridge, at_hz: number) => {
        const found = Math.abs(response(bridge, at_hz, tick_s)[passes_zero ? 1 : 0]);
        return found > rounding * tick_s ? found : 0;
    };
    const by_frequency = (amplitude: number) => here.map((bridge): Curve => (at_hz) => amplitude * error(bridge, at_hz));
    const by_amplitude = (at_hz: number) => here.map((bridge): Curve => (amplitude) => amplitude * error(bridge, at_hz));
    const lengths = evenly(1, Math.max(10, gap_ticks + 2), Math.max(10, gap_ticks + 2));
    const by_length = new Map(lengths.map((ticks) => [ticks, bridges(module, settings, ticks).map((bridge) => n_sigmas * rounding_arcsec(bridge, count_arcsec))]));
    const noise = here.map((_, at): Curve => (ticks) => by_length.get(ticks)![at]);
    return {
        gap_ticks,
        amplitude_arcsec_s,
        frequency_hz,
        oscillates: moves.length > 0,
        error_arcsec: here.map((bridge) => amplitude_arcsec_s * error(bridge, frequency_hz)),
        noise_arcsec: by_length.get(gap_ticks)!,
        by_frequency: table(evenly(0, Math.max(0.2 / tick_s, 1.25 * Math.max(frequency_hz, ...moves.map(([, at_hz]) => at_hz))), 81), by_frequency(amplitude_arcsec_s), moves.flatMap(([amplitude, at_hz]) => marks_at(at_hz, by_frequency(amplitude)))),
        by_amplitude: table([0, Math.max(example.amplitude_arcsec_s, 1.25 * amplitude_arcsec_s)], by_amplitude(frequency_hz), moves.flatMap(([amplitude, at_hz]) => marks_at(amplitude, by_amplitude(at_hz)))),
        noise: table(lengths, noise, marks_at(gap_ticks, noise)),
    };
}

// switch_error_arcsec  rms, that a switch leaves; null: it is not known.
// passes_zero          the rate in the middle of a gap; else it has an extremum there.
export function design_of(module: LoopModule, settings: Settings, switch_error_arcsec: number | null, passes_zero: boolean): Design {
    return { ...intervals(module, settings, switch_error_arcsec), ...gaps(module, settings, passes_zero) };
}

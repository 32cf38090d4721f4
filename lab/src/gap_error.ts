// The error of a gap that is bridged by a polynomial: of a rate that oscillates, and by the rounding of the counter.

// The weights W with which the points, at ticks x, give the angle of the ticks 1 ... n (lab/module/design_formulas.hpp).
export interface Bridge {
    gap_ticks: number;
    places: number[];
    weights: number[];
}

// How the error answers to an oscillation A sin(w t + phase) of the rate, t = 0 in the middle of the gap:
//
//   H(f) = T sinc(pi f T) [ sum_k W_k e^(i w (x_k - c) T) - sum_j e^(i w (j - c) T) ],   w = 2 pi f, c = (n + 1)/2
//   error = A Im(H e^(i phase))
//
// Its real part is the error, in arcsec for an arcsec/s, where the rate has an extremum in the middle of the gap, its imaginary part
// where it passes zero there.
export function response(bridge: Bridge, frequency_hz: number, tick_s: number): [number, number] {
    const half = Math.PI * frequency_hz * tick_s; // of the phase over a tick
    const middle = (bridge.gap_ticks + 1) / 2;
    const sum = [0, 0];
    const add = (weight: number, place: number) => {
        sum[0] += weight * Math.cos(2 * half * (place - middle));
        sum[1] += weight * Math.sin(2 * half * (place - middle));
    };
    bridge.places.forEach((place, k) => add(bridge.weights[k], place));
    for (let tick = 1; tick <= bridge.gap_ticks; ++tick) add(-1, tick);
    const mean = tick_s * (half === 0 ? 1 : Math.sin(half) / half);
    return [mean * sum[0], mean * sum[1]];
}

// Sigma of the gap where each reading of the counter is rounded to a count: of independent roundings, uniform within a count. A tick is the
// difference of two of them, so neighbours share one.
export function rounding_arcsec(bridge: Bridge, count_arcsec: number): number {
    const of_reading = new Map<number, number>();
    bridge.places.forEach((place, k) => {
        of_reading.set(place, (of_reading.get(place) ?? 0) + bridge.weights[k]);
        of_reading.set(place - 1, (of_reading.get(place - 1) ?? 0) - bridge.weights[k]);
    });
    const squares = [...of_reading.values()].reduce((sum, weight) => sum + weight ** 2, 0);
    return count_arcsec * Math.sqrt(squares / 12);
}

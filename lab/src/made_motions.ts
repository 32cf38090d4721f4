// Short motions that the page makes by formula, as files like those of a reader.

const rate_hz = 200;

interface Made {
    duration_s: number;
    deg_s: (t_s: number) => number;
}

// From 0 to 1 within [from, to], with rest at both ends.
function smooth(t: number, from: number, to: number): number {
    const x = Math.min(Math.max((t - from) / (to - from), 0), 1);
    return x * x * (3 - 2 * x);
}

const motions: Record<string, Made> = {
    // A rate table: rest, 10, -10, 50, -50 deg/s, eight seconds each, with ramps of half a second.
    table_in_steps: {
        duration_s: 40,
        deg_s: (t) => [10, -10, 50, -50].reduce((rate, step, k) => rate + step * (smooth(t, 8 * k + 4, 8 * k + 4.5) - smooth(t, 8 * k + 11.5, 8 * k + 12)), 0),
    },
    // A hand that turns the case to and fro, with the tremor of 8 to 12 Hz of a muscle that holds.
    turned_by_hand: {
        duration_s: 30,
        deg_s: (t) => 60 * Math.sin(1.3 * t) * Math.sin(0.21 * t + 0.4) ** 2 + 1.2 * Math.sin(2 * Math.PI * 8.7 * t) + 0.7 * Math.sin(2 * Math.PI * 11.3 * t + 1),
    },
    // A car: bends, the body on its springs at 1.4 Hz, axles at 11 and the engine at 27 Hz.
    car: {
        duration_s: 60,
        deg_s: (t) => 18 * (smooth(t, 8, 11) - smooth(t, 16, 19)) - 25 * (smooth(t, 30, 32) - smooth(t, 36, 39)) + (1.5 + Math.sin(0.5 * t)) * Math.sin(2 * Math.PI * 1.4 * t) + 0.5 * Math.sin(2 * Math.PI * 11.2 * t) * Math.sin(0.9 * t) + 0.15 * Math.sin(2 * Math.PI * 27.3 * t),
    },
};

export const made_motion_names = Object.keys(motions);

export function made_motion(name: string): File {
    const { duration_s, deg_s } = motions[name];
    const rows = Array.from({ length: duration_s * rate_hz }, (_, k) => `${k / rate_hz},${Number(deg_s((k + 0.5) / rate_hz).toFixed(6))}\n`);
    return new File([`t_s,rate_deg_s\n${rows.join("")}`], `${name}.csv`, { type: "text/csv" });
}

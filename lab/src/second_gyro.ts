// The card of the second gyro: this one, never switched, as settings over those of the first.
import { element } from "./elements";

const never_switched = ["switching.schedule=fixed", "switching.interval_s=1000000"];

const kind = () => element<HTMLSelectElement>("other");

// Null: there is none.
export function second_gyro(): string[] | null {
    return kind().value === "none" ? null : never_switched;
}

export function choose_second_gyro(which: "one_mode" | "none"): void {
    kind().value = which;
}

// One that cannot be run with these settings is left out; true: it was so.
export function leave_out_second_gyro(refusal: string): boolean {
    const is_left_out = refusal.startsWith("the second gyro: ");
    if (is_left_out) choose_second_gyro("none");
    return is_left_out;
}

export function listen_to_second_gyro(on_change: () => void): void {
    kind().addEventListener("change", on_change);
}

// The card of the second gyro: which it is, as settings over those of the first.
import { element, lines_of } from "./elements";

const never_switched = ["switching.schedule=fixed", "switching.interval_s=1000000"];

const kind = () => element<HTMLSelectElement>("other");

export const has_own_second = () => kind().value === "own";

// Null: there is none.
export function second_gyro(): string[] | null {
    if (kind().value === "none") return null;
    return kind().value === "one_mode" ? never_switched : lines_of("other-settings");
}

export function choose_second_gyro(which: "one_mode" | "none"): void {
    kind().value = which;
    element("other-settings-label").hidden = true;
}

// One that the page itself had put there cannot be run with these settings: it is left out; true: it was so.
export function leave_out_second_gyro(refusal: string): boolean {
    const is_left_out = refusal.startsWith("the second gyro: ") && kind().value === "one_mode";
    if (is_left_out) choose_second_gyro("none");
    return is_left_out;
}

export function listen_to_second_gyro(on_change: () => void): void {
    kind().addEventListener("change", () => {
        element("other-settings-label").hidden = kind().value !== "own";
        on_change();
    });
    element("other-settings").addEventListener("change", on_change);
}

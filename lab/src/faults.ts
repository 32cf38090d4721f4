// A button for every fault: it is added to the configuration, so that the gyro until then is the same and a link repeats it.
import { made } from "./elements";
import type { Fault } from "./protocol";
import { given } from "./settings";

const delay_s = 0.1;

// The settings with one more fault.
export function with_fault(settings: string[], fault: Fault, now_s: number): string[] {
    const middle = 0.5 * (fault.least + fault.most);
    const more: Record<string, unknown> = {
        kind: fault.name,
        at_s: Number((now_s + delay_s).toFixed(4)),
        duration_s: fault.duration_s,
        size: fault.name === "counter_bit_stuck" || fault.name === "light_stuck" ? Math.round(middle) : middle,
    };
    const lists = Object.entries(more).map(([name, value]) => `faults.${name}=${JSON.stringify([...given(settings, `faults.${name}`), value])}`);
    return [...settings.filter((setting) => !Object.keys(more).some((name) => setting.startsWith(`faults.${name}=`))), ...lists];
}

// What stands where the gyro has reported nothing yet.
export function nothing_yet(fault: Fault): string {
    return /^switch_|^half_wave_error/.test(fault.name) ? "nothing yet; it shows at the next switch" : "nothing yet";
}

export function fault_buttons(place: HTMLElement, faults: Fault[], on_fault: (fault: Fault) => void): void {
    for (const fault of faults) {
        const button = made("button", fault.name.replaceAll("_", " "), { type: "button", title: `for ${fault.duration_s} s` });
        button.addEventListener("click", () => on_fault(fault));
        place.append(button);
    }
}

// A button for every fault: it is added to the configuration, so that the gyro until then is the same and a link repeats it.
import { made } from "./elements";
import type { Fault } from "./protocol";
import { given } from "./settings";

const delay_s = 0.1;

// What acts on a switch alone.
const of_a_switch = (fault: Fault) => /^switch_|^half_wave_error/.test(fault.name);

// What acts on a switch lasts until the next one, which comes after to_switch_s.
function duration_s(fault: Fault, to_switch_s: number): number {
    return of_a_switch(fault) ? Number((to_switch_s + fault.duration_s).toFixed(4)) : fault.duration_s;
}

export interface MadeFault {
    kind: Fault;
    at_s: number; // when its button was pressed
    end_s: number;
}

export function made_fault(kind: Fault, at_s: number, to_switch_s: number): MadeFault {
    return { kind, at_s, end_s: at_s + delay_s + duration_s(kind, to_switch_s) };
}

// The settings with one more fault.
export function with_fault(settings: string[], fault: Fault, now_s: number, to_switch_s: number): string[] {
    const middle = 0.5 * (fault.least + fault.most);
    const more: Record<string, unknown> = {
        kind: fault.name,
        at_s: Number((now_s + delay_s).toFixed(4)),
        duration_s: duration_s(fault, to_switch_s),
        size: fault.name === "counter_bit_stuck" || fault.name === "light_stuck" ? Math.round(middle) : middle,
    };
    const lists = Object.entries(more).map(([name, value]) => `faults.${name}=${JSON.stringify([...given(settings, `faults.${name}`), value])}`);
    return [...settings.filter((setting) => !Object.keys(more).some((name) => setting.startsWith(`faults.${name}=`))), ...lists];
}

// What stands where the gyro has reported nothing. What a fault does is seen a second later at most.
export function words_without_alarm(fault: MadeFault, time_s: number): string {
    if (time_s > fault.end_s + 1) return "nothing; it did no harm, or none that the gyro can see";
    return of_a_switch(fault.kind) ? "nothing yet; it acts on the next switch" : "nothing yet";
}

export function fault_buttons(place: HTMLElement, faults: Fault[], on_fault: (fault: Fault) => void): void {
    for (const fault of faults) {
        const button = made("button", fault.name.replaceAll("_", " "), { type: "button", title: `for ${fault.duration_s} s` });
        button.addEventListener("click", () => on_fault(fault));
        place.append(button);
    }
}

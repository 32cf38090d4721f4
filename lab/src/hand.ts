// The slider that turns the case. It springs back when it is let go, by pointer or by key.
import { element } from "./elements";
import { short } from "./plots";

export function turn_by_hand(on_turn: (rate_arcsec_s: number) => void): void {
    const pad = element<HTMLInputElement>("pad");
    const turn = () => {
        element("pad-text").textContent = `${short(Number(pad.value))} deg/s`;
        on_turn(Number(pad.value) * 3600);
    };
    const let_go = () => {
        if (Number(pad.value) === 0) return;
        pad.value = "0";
        turn();
    };
    pad.addEventListener("input", turn);
    for (const event of ["pointerup", "pointercancel", "keyup", "blur"]) pad.addEventListener(event, let_go);
}

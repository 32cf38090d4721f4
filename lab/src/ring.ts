// The drawing of the ring, and the numbers of the half before.
import { made, part } from "./elements";
import { short } from "./plots";
import type { Frame } from "./protocol";

const corners = [
    [70, 70],
    [250, 70],
    [250, 210],
    [70, 210],
];
const perimeter = 2 * (180 + 140);

// The place after so much of the way round, 0..1.
function on_ring(part_of_way: number): [number, number] {
    let way = (part_of_way - Math.floor(part_of_way)) * perimeter;
    for (let side = 0; side < 4; ++side) {
        const [x0, y0] = corners[side];
        const [x1, y1] = corners[(side + 1) % 4];
        const length = Math.abs(x1 - x0) + Math.abs(y1 - y0);
        if (way <= length) return [x0 + ((x1 - x0) * way) / length, y0 + ((y1 - y0) * way) / length];
        way -= length;
    }
    return [corners[0][0], corners[0][1]];
}

const phases = ["tracking", "gap: loop open", "settling", "returning", "searching"];
const waves = 16;

export const never_s = 1e5; // nobody waits so long

export function switches_again(frame: Frame): boolean {
    return frame.now[10] < never_s;
}

export class RingDrawing {
    private readonly turning: SVGElement;
    private readonly beams: { a: SVGElement[]; b: SVGElement[] };
    private readonly beam: SVGElement;
    private readonly mirrors: SVGElement[];
    private readonly coil: SVGElement;
    private readonly coil_text: SVGElement;
    private readonly diodes: SVGElement[];
    private readonly mode_text: SVGElement;
    private readonly loop_text: SVGElement;
    private readonly values: Record<string, HTMLElement> = {};
    private brightest = 1e-9; // of all light so far
    private way_a = 0;
    private way_b = 0;
    private frame: Frame | null = null;
    private still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;

    constructor(place: HTMLElement, list: HTMLElement) {
        const drawing = part(place, "svg", { viewBox: "0 0 320 290", role: "img", "aria-label": "Ring of four mirrors with two counter-running beams, piezo mirrors, magnet coil and photodiodes" });
        this.turning = part(drawing, "g", {});
        this.beam = part(this.turning, "path", { d: "M70 70H250V210H70Z", fill: "none", "stroke-width": 5, "stroke-linejoin": "round", class: "beam" });
        this.mirrors = corners.map(([x, y], at) => {
            const angle = [-45, 45, -45, 45][at];
            const group = part(this.turning, "g", { transform: `translate(${x} ${y}) rotate(${angle})` });
            part(group, "rect", { x: -17, y: -4, width: 34, height: 8, rx: 2, fill: "currentColor" });
            return group;
        });
        for (const [x, y, text] of [[36, 52, "mirror"], [284, 52, "piezo"], [284, 238, "mirror"], [36, 238, "piezo"]] as const) part(this.turning, "text", { x, y, "text-anchor": "middle", "font-size": 11, fill: "currentColor", opacity: 0.7 }, text);
        this.coil = part(this.turning, "rect", { x: 120, y: 56, width: 80, height: 28, rx: 6, fill: "none", "stroke-width": 2.5, stroke: "currentColor" });
        this.coil_text = part(this.turning, "text", { x: 160, y: 47, "text-anchor": "middle", "font-size": 12, fill: "currentColor" });
        this.beams = { a: this.dots("--ours"), b: this.dots("--read") };
        this.diodes = [[128, 236], [192, 236]].map(([x, y]) => part(this.turning, "circle", { cx: x, cy: y, r: 9, stroke: "currentColor", "stroke-width": 1.5 }));
        part(this.turning, "text", { x: 128, y: 262, "text-anchor": "middle", "font-size": 11, fill: "currentColor" }, "light A");
        part(this.turning, "text", { x: 192, y: 262, "text-anchor": "middle", "font-size": 11, fill: "currentColor" }, "light B");
        this.mode_text = part(drawing, "text", { x: 160, y: 138, "text-anchor": "middle", "font-size": 19, "font-weight": 600, fill: "currentColor" });
        this.loop_text = part(drawing, "text", { x: 160, y: 160, "text-anchor": "middle", "font-size": 13, fill: "currentColor" });
        for (const name of ["Rate of the case", "Detuning", "Piezo", "Next switch", "Runs at"]) {
            this.values[name] = made("dd");
            list.append(made("dt", name), this.values[name]);
        }
        requestAnimationFrame((ms) => this.animate(ms, ms));
    }

    private dots(colour: string): SVGElement[] {
        return Array.from({ length: waves }, () => {
            const dot = part(this.turning, "circle", { r: 3.2 });
            (dot as SVGCircleElement).style.fill = `var(${colour})`;
            return dot;
        });
    }

    show(frame: Frame): void {
        this.frame = frame;
        const [rate, , detuning, piezo, light_a, light_b, mode, bias, closed, phase, to_switch] = frame.now;
        const lit = closed > 0;
        // A degree a second of the case is drawn as a degree of the ring.
        const turn = Math.max(-20, Math.min(20, rate / 3600));
        this.turning.setAttribute("transform", `rotate(${turn.toFixed(2)} 160 140)`);
        (this.beam as SVGElement & ElementCSSInlineStyle).style.stroke = mode > 0 ? "var(--true)" : "var(--paper)";
        this.beam.setAttribute("opacity", lit ? "0.8" : "0.25");
        const shift = Math.max(-12, Math.min(12, detuning * 60));
        [1, 3].forEach((at) => this.mirrors[at].setAttribute("transform", `translate(${corners[at][0] + (at === 1 ? shift : -shift) / 1.4} ${corners[at][1] + (at === 1 ? -shift : shift) / 1.4}) rotate(45)`));
        this.coil_text.textContent = bias > 0 ? "magnet: bias +" : "magnet: bias −";
        this.coil.setAttribute("stroke-dasharray", bias > 0 ? "none" : "5 3");
        this.brightest = Math.max(this.brightest, light_a || 0, light_b || 0);
        [light_a, light_b].forEach((light, at) => {
            (this.diodes[at] as SVGElement & ElementCSSInlineStyle).style.fill = `color-mix(in srgb, ${at === 0 ? "var(--ours)" : "var(--read)"} ${Math.round((100 * Math.max(0, light || 0)) / this.brightest)}%, transparent)`;
        });
        const begun = frame.time_s > 0;
        this.mode_text.textContent = begun ? `mode ${mode > 0 ? "+1" : "−1"}` : "at the start";
        this.loop_text.textContent = begun ? (phases[phase] ?? "") : "";
        this.values["Rate of the case"].textContent = `${short(rate / 3600, 3)} deg/s`;
        this.values["Detuning"].textContent = `${short(detuning, 3)} λ`;
        this.values["Piezo"].textContent = begun ? `${piezo.toFixed(2)} V` : "–";
        this.values["Next switch"].textContent = !begun ? "–" : !switches_again(frame) ? "never" : to_switch > 0 ? `in ${to_switch.toFixed(2)} s` : "now";
        this.values["Runs at"].textContent = frame.state !== "running" ? frame.state : frame.speed > 0 ? `${short(frame.speed, 3)} × real time` : "–";
    }

    // Two waves round the ring; they run apart as bias and rotation part their frequencies.
    private animate(before_ms: number, ms: number): void {
        const frame = this.frame;
        if (frame !== null && (frame.state === "running" || this.way_a === 0)) {
            const step = this.still ? 0 : Math.min((ms - before_ms) / 1000, 0.1);
            const split = Math.max(-0.8, Math.min(0.8, frame.now[7] * 0.35 + frame.now[0] / 108000));
            this.way_a += step * 0.1 * (1 + split) + 1e-9;
            this.way_b += step * 0.1 * (1 - split);
            this.beams.a.forEach((dot, at) => this.put(dot, this.way_a + at / waves));
            this.beams.b.forEach((dot, at) => this.put(dot, -this.way_b + (at + 0.5) / waves));
        }
        requestAnimationFrame((next) => this.animate(ms, next));
    }

    private put(dot: SVGElement, way: number): void {
        const [x, y] = on_ring(way);
        dot.setAttribute("cx", x.toFixed(1));
        dot.setAttribute("cy", y.toFixed(1));
    }
}

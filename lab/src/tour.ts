// The tour: ten steps that tell, on the live gyro, why a Zeeman laser gyro switches its mode and what that costs.

export interface Step {
    title: string;
    text: string;
    look: string; // id of the card that is shown
    settings: string[];
    other: "one_mode" | "none";
    speed: number;
    window_s: string;
}

const slow_motion = ["motion.amplitude_arcsec_s=12000", "motion.frequency_hz=7.03"];
const steady_drift = ["drift.magnetic_thermal_arcsec_s=0", "drift.nonmagnetic_arcsec_s=0", "drift.random_walk_arcsec_sqrt_s=0"];

export const steps: Step[] = [
    { title: "Light that runs round", look: "card-ring", settings: ["motion.kind=rest"], other: "none", speed: 1, window_s: "5", text: "A laser gyro is a ring in which two beams of light run in opposite directions. When the case turns, one way round becomes longer than the other, and the two beams differ in frequency. Counting their beat gives the angle: one count is 3.263 arcsec here. The case is at rest. Turn it: drag the slider under the drawing and hold it, or focus it and use the arrow keys. The number “Rate of the case” says how fast it turns, and the drawing leans the more, the faster it turns. Let go, and it rests again." },
    { title: "Why there is a magnet", look: "card-ring", settings: slow_motion, other: "none", speed: 0.01, window_s: "0.25", text: "At small rates the two beams would lock together and the gyro would be blind. The magnet splits their frequencies by 60 kHz, a “bias” that keeps them apart. Its sign changes every 2.5 ms, so that it cancels in the sum of two half-periods: a tick of 5 ms. Time runs a hundred times slower now. Watch the frame labelled “magnet”: it is solid for + and dashed for −." },
    { title: "What the magnet spoils", look: "card-error", settings: ["switching.interval_s=1000000", ...steady_drift], other: "none", speed: 64, window_s: "5", text: "But the gyro takes a constant magnetic field for a turn: here 0.7 arcsec every second, which is 0.7 degrees in an hour. The error of the angle only grows. Nothing in the counts tells it from a true rotation. (The three lines lie on top of each other: as long as nothing is switched, nothing can be corrected.)" },
    { title: "The trick: the other mode", look: "card-error", settings: ["switching.interval_s=20", ...steady_drift], other: "one_mode", speed: 64, window_s: "30", text: "The ring can carry light of two kinds, called modes +1 and −1 (green and brown in the drawing). In the one the field of the light turns like a right-hand screw, in the other like a left-hand one, and a magnetic field fakes turns of opposite sign. So the gyro switches every 20 s, and what the one mode adds the other takes away. Look at the blue line: the error makes a saw and comes back. The grey line is the same gyro on the same motion that never switches. The red line jumps at every switch: it holds what a switch costs, of which the next steps speak." },
    { title: "How a switch is made", look: "card-switch", settings: ["switching.interval_s=1"], other: "none", speed: 1, window_s: "5", text: "Piezo mirrors make the ring half a wavelength longer or shorter; there the other mode lases. A control loop holds the length of the ring; for the way to the other mode it is opened, for 3 ticks, 15 ms. In this gap the counter’s numbers mean nothing: in the chart the red points leave the green line of the true rate. They come back a few ticks after the gap; step 7 tells why. Here a switch comes every second." },
    { title: "Bridging the gap", look: "card-switch", settings: ["switching.interval_s=1"], other: "none", speed: 1, window_s: "1", text: "What the case did in these 15 ms must be guessed: at once from the ticks before (extrapolated, for whoever steers by it), and a little later from both sides (interpolated, and better). The more the case shakes, the harder the guess. At 7 oscillations a second, as here, the paper’s way leaves 7 arcsec in the angle (root mean square of 249 switches), this program 2.2, once it has learnt how the case moves. At 15 oscillations a second it is 11 and 2.8." },
    { title: "The loop comes back", look: "card-signals", settings: ["switching.interval_s=1"], other: "none", speed: 0.5, window_s: "1", text: "When the loop closes, the ring is a fifth of a wavelength off, and the loop pulls it back: watch the spike of “detuning” at each switch. While the ring is detuned the bias is a little smaller, and that looks like a turn: a false angle of some 240 arcsec at every switch. It is subtracted, by the measured detuning." },
    { title: "What a switch costs", look: "card-histogram", settings: ["switching.interval_s=4"], other: "none", speed: 100, window_s: "30", text: "Each switch leaves an error in the angle for ever. As read from the counter it is some 250 arcsec; corrected as in the paper about 7, at times over 15; as this program does it about 2. The bars count the switches by the size of their error; those of this program stand farthest to the left." },
    { title: "How often to switch", look: "card-design", settings: ["switching.interval_s=90"], other: "none", speed: 100, window_s: "30", text: "Switch too often, and the errors of many switches add up. Switch too rarely, and the drift no longer cancels, for it grows while the gyro warms up. Between them is a best interval: the lowest point of a curve on the left, one curve for each length of the run; on the right it is drawn by that length. The green dots are this gyro. What a switch costs is presumed at first and measured once five have passed: then the curves move." },
    { title: "Break it", look: "card-faults", settings: ["switching.interval_s=4"], other: "none", speed: 1, window_s: "5", text: "The gyro watches itself. Press a fault: the light goes out, the mode hops, a bit of the counter sticks. Above the buttons stands what it reports. While it is blind nobody knows how the case turns: the program holds a guess and marks these ticks in its log, with the error to be expected; that error stays in the angle. This is the end of the tour: all controls are yours, and this step’s settings stay until you change them." },
];

const catches_clicks_ms = 500;

export class Tour {
    private ending = 0; // timers
    private bringing = 0;

    constructor(
        private readonly place: HTMLElement,
        private readonly on_step: (step: Step) => void,
        private readonly on_end: () => void, // where the keyboard was in it
    ) {
        // Who has scrolled himself is left where he is.
        for (const event of ["wheel", "touchmove"]) window.addEventListener(event, () => clearTimeout(this.bringing), { passive: true });
    }

    go(at: number): void {
        document.querySelector(".card.shown")?.classList.remove("shown");
        const step = steps[at];
        clearTimeout(this.ending);
        clearTimeout(this.bringing);
        this.place.classList.toggle("ending", step === undefined);
        if (step === undefined) {
            // For a moment it still catches clicks: a second one on "Done" is none on what lies below.
            this.ending = window.setTimeout(() => this.end(), catches_clicks_ms);
            return;
        }
        this.place.hidden = false;
        const card = document.getElementById(step.look)!;
        card.classList.add("shown");
        const box = document.createElement("div");
        const number = Object.assign(document.createElement("p"), { className: "step", id: "tour-step", textContent: `Step ${at + 1} of ${steps.length}` });
        const title = Object.assign(document.createElement("h2"), { textContent: step.title, id: "tour-title" });
        const text = Object.assign(document.createElement("p"), { textContent: step.text, id: "tour-text" });
        const row = Object.assign(document.createElement("div"), { className: "row" });
        const button = (name: string, to: number, main = false) => {
            const made = Object.assign(document.createElement("button"), { type: "button", textContent: name, className: main ? "main" : "" });
            made.addEventListener("click", () => {
                if (!this.place.classList.contains("ending")) this.go(to);
            });
            row.append(made);
            return made;
        };
        button("Back", at - 1).disabled = at === 0;
        const next = button(at + 1 < steps.length ? "Next" : "Done", at + 1, true);
        if (at + 1 < steps.length) button("End the tour", -1);
        box.append(number, title, text, row);
        this.place.replaceChildren(box);
        // Read out with the button that has the focus.
        next.setAttribute("aria-describedby", "tour-step tour-title tour-text");
        next.focus({ preventScroll: true });
        this.on_step(step);
        this.bring(card);
        // What stands above it may have grown or shrunk with the new gyro.
        this.bringing = window.setTimeout(() => this.bring(card), 700);
    }

    private end(): void {
        const has_focus = this.place.contains(document.activeElement);
        this.place.hidden = true;
        if (has_focus) this.on_end();
    }

    private bring(card: HTMLElement): void {
        // Of a card that is higher than the room above the tour, its beginning; where that holds no chart, its first chart.
        const room = window.innerHeight - this.place.offsetHeight - 90;
        const chart = card.querySelector<HTMLElement>(".plot");
        const is_high = card.offsetHeight > room;
        const is_low = chart !== null && chart.getBoundingClientRect().bottom - card.getBoundingClientRect().top > room;
        const is_still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
        (is_low ? chart : card).scrollIntoView({ block: is_high ? "start" : "nearest", behavior: is_still ? "auto" : "smooth" });
    }
}

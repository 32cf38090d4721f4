// A log of the reader's own: a worker of its own reads it, so that it can be ended at any time, and its charts stand above those of the gyro.
import { compared_lines } from "./compensations";
import { GyroClient } from "./client";
import { element, finite, lines_of, made, positive } from "./elements";
import { MagnifiedSwitch } from "./magnified";
import { Chart, short } from "./plots";
import type { LogPicture } from "./protocol";

export class LogView {
    private charts: { angle: Chart; rate: Chart; difference: Chart; detuning: Chart; piezo: Chart; allan: Chart; last_switch: MagnifiedSwitch } | null = null;
    private worker: GyroClient | null = null;
    private file: File | null = null;

    // make_worker  a worker whose module is loaded, with that listener.
    constructor(
        private readonly make_worker: (listener: Partial<ConstructorParameters<typeof GyroClient>[2]>) => GyroClient,
        private readonly flag_names: () => string[],
    ) {
        element("log-again").addEventListener("click", () => this.read());
        element("log-close").addEventListener("click", () => {
            this.finish("", "closed");
            element("card-log").hidden = true;
        });
    }

    open(file: File): void {
        this.file = file;
        element("card-log").hidden = false;
        element("card-log").scrollIntoView({ block: "start" });
        this.read();
    }

    private read(): void {
        const file = this.file;
        if (file === null) return;
        this.end_worker();
        this.say(`Reading ${file.name} …`, "reading");
        element("log-result").hidden = true;
        element("log-notes").replaceChildren();
        element<HTMLProgressElement>("log-progress").value = 0;
        const settings = lines_of("log-settings");
        this.worker = this.make_worker({
            loaded: () => this.worker?.send({ kind: "read_log", file, settings }),
            refused: ({ message }) => this.finish(message, "refused"),
            log_progress: ({ fraction, ticks }) => {
                element<HTMLProgressElement>("log-progress").value = fraction;
                this.say(`Reading ${file.name}: ${ticks} ticks …`, "reading");
            },
            log_read: ({ log }) => this.show(log),
        });
    }

    private end_worker(): void {
        this.worker?.end();
        this.worker = null;
    }

    private finish(text: string, state: string): void {
        this.end_worker();
        this.say(text, state);
    }

    private say(text: string, state: string): void {
        element("log-text").textContent = text;
        element("card-log").dataset.state = state;
        element("log-work").hidden = state !== "reading";
        element("log-text").classList.toggle("wrong", state === "refused");
        element<HTMLButtonElement>("log-again").disabled = state === "reading";
    }

    private make_charts() {
        element("log-result").hidden = false;
        const chart = (name: string, y: string, lines: ConstructorParameters<typeof Chart>[1]["lines"], more = {}) => new Chart(element(`plot-log-${name}`), { x: "time, s", y, height: 190, sync: "log", lines, ...more });
        this.charts ??= {
            angle: chart("angle", "angle, arcsec", [{ label: "angle, as configured", colour: "--ours", unit: "arcsec" }]),
            rate: chart("rate", "rate, arcsec/s", [{ label: "as configured", colour: "--ours", unit: "arcsec/s" }, { label: "as read", colour: "--read", unit: "arcsec/s", dash: [4, 3] }]),
            difference: chart("difference", "difference, arcsec", compared_lines("arcsec").slice(0, 2)),
            detuning: chart("detuning", "detuning, λ", [{ label: "detuning of the perimeter", colour: "--ours", unit: "λ" }]),
            piezo: chart("piezo", "piezo, V", [{ label: "voltage at the piezo mirrors", colour: "--paper", unit: "V" }]),
            allan: chart("allan", "deviation, deg/h", compared_lines("deg/h"), { x: "averaging time, s", log_x: true, log_y: true, sync: "" }),
            last_switch: new MagnifiedSwitch("log-switch", "Extrapolated less interpolated, dP", false),
        };
        return this.charts;
    }

    private show(log: LogPicture): void {
        const charts = this.make_charts();
        const drawn = (columns: Float64Array[], ...which: number[]) => [columns[0], ...which.map((at) => Array.from(columns[at], finite))];
        charts.angle.show(drawn(log.angle, 1));
        charts.rate.show(drawn(log.rate, 1, 2));
        charts.difference.show(drawn(log.difference, 1, 2));
        charts.detuning.show(drawn(log.light, 1));
        charts.piezo.show(drawn(log.light, 2));
        charts.allan.show(log.allan.map((column) => Array.from(column, positive)));
        const empty = (columns: Float64Array[], at: number) => !columns[at].some(Number.isFinite);
        element("plot-log-detuning").hidden = empty(log.light, 1);
        element("plot-log-piezo").hidden = empty(log.light, 2);
        element("log-difference").hidden = empty(log.difference, 1);
        element("log-switches").hidden = log.picture === null;
        if (log.picture !== null) charts.last_switch.show(log.picture);
        this.show_flags(log.flags);
        const settings = log.settings.length > 0 ? [`Settings that differ from the defaults: ${log.settings.join(", ")}`] : [];
        element("log-notes").replaceChildren(...[...log.notes, ...settings].map((note) => made("li", note)));
        const switches = log.n_switches > 0 ? `, ${log.n_switches} switches (rms dP ${short(log.rms_dp_arcsec, 3)} arcsec)` : "";
        this.finish(`${log.name}: ${log.kind === "raw" ? "a raw log, compensated here" : "an angle log"}; ${log.ticks} ticks of ${short(log.tick_s * 1000)} ms, ${short(log.ticks * log.tick_s, 6)} s; ${log.gaps} gaps${switches}; accumulated angle ${short(log.angle_arcsec, 12)} arcsec.`, "shown");
    }

    private show_flags(flags: number[]): void {
        const names = this.flag_names();
        const items = flags.flatMap((n, bit) => (n > 0 ? [made("li", `${(names[bit] ?? `bit ${bit}`).replaceAll("_", " ")}: ${n}`)] : []));
        element("log-flags").replaceChildren(...(items.length > 0 ? items : [made("li", "nothing to report", { class: "good" })]));
    }
}

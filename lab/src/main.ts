// The lab page: puts the parts together.
import { GyroClient, type Listener } from "./client";
import { Controls } from "./controls";
import { element, marked } from "./elements";
import { fault_buttons, type MadeFault, made_fault, words_without_alarm, with_fault } from "./faults";
import { choose_file, on_drop } from "./files";
import { follows_records } from "./follow";
import { parse_fragment } from "./fragment";
import { Frames } from "./frames";
import { turn_by_hand } from "./hand";
import { HealthList } from "./health";
import { LogView } from "./log_view";
import { keep_charts, short } from "./plots";
import type { Fault, Frame, Key, Schema, State } from "./protocol";
import { never_s, RingDrawing, switches_again } from "./ring";
import { Settings } from "./settings";
import { share_dialog } from "./share";
import { Views } from "./views";

// The gyro of a page that is opened without one: it switches often, and begins where it has done so in either direction.
const first_fragment = "#switching.interval_s=4";
const first_time_s = 8.5;
const longest_repeat_s = 120; // of a gyro that is changed while it runs: later it begins again

interface Asked {
    settings: string[];
    from_s: number; // be at this time at once
    until_s: string | null;
    by_controls: boolean;
    fault: MadeFault | null; // that was made last
}

class Lab {
    private readonly views = new Views();
    private readonly ring = new RingDrawing(element("ring"), element("now"));
    private readonly client: GyroClient;
    private readonly log: LogView;
    private keys: Key[] = [];
    private flag_names: string[] = []; // of an angle log
    private controls: Controls | null = null;
    private health: HealthList | null = null;
    private settings: string[] = []; // of the gyro that runs
    private asked: Asked = { settings: [], from_s: 0, until_s: null, by_controls: false, fault: null }; // for last; the worker may not have it yet
    private time_s = 0; // of the gyro that was asked for, once it is there
    private fault: MadeFault | null = null; // of the gyro that runs
    private wants_to_run = true;
    private refused = false; // by a link, or in the run: there is nothing to show
    private from_link = false;
    private frame: Frame | null = null;
    private readonly frames = new Frames((frame) => this.draw(frame), () => this.client.send({ kind: "seen" }));

    constructor() {
        const worker = (listener: Partial<Listener>) => new GyroClient(element("worker").textContent!, element("module").textContent!, listener);
        this.log = new LogView(worker, () => this.flag_names);
        this.client = worker({
            loaded: ({ schema }) => this.loaded(schema),
            configured: ({ changed }) => this.configured(changed, !this.client.waits()),
            refused: ({ message, whole }) => this.refuse(message, whole),
            frame: (frame) => this.frames.take(frame),
        });
        this.listen();
        keep_charts();
    }

    private loaded(schema: Schema): void {
        this.controls = new Controls(element("controls"), element<HTMLInputElement>("search"), schema.keys, () => this.changed_by_hand());
        this.health = new HealthList(element("health"), schema.health);
        fault_buttons(element("faults"), schema.faults, (fault) => this.break_it(fault));
        this.flag_names = schema.angle_flags;
        this.keys = schema.keys;
        this.send_speed();
        const has_none = location.hash === "";
        if (has_none) history.replaceState(null, "", first_fragment);
        this.open_link(has_none ? first_time_s : 0);
    }

    private open_link(from_s = 0): void {
        this.from_link = true;
        try {
            const wanted = parse_fragment(location.hash);
            this.begin(wanted.settings, { until_s: wanted.until_s, from_s, fault: null });
        } catch (error) {
            this.refuse((error as Error).message, true);
        }
    }

    // A gyro of these settings.
    private begin(settings: string[], { from_s = 0, until_s = null, by_controls = false, fault = this.asked.fault }: Partial<Asked> = {}): void {
        this.asked = { settings, from_s, until_s, by_controls, fault };
        if (!by_controls) this.controls?.expect(settings);
        this.time_s = from_s;
        this.client.configure({ settings, until_s, from_s, fault_s: fault?.at_s ?? null }, this.wants_to_run);
    }

    private configured(changed: string[], is_newest: boolean): void {
        this.settings = changed;
        this.frames.forget();
        this.views.begin();
        if (!is_newest) return;
        this.asked.settings = this.settings;
        this.fault = this.asked.fault;
        this.refused = false;
        this.from_link = false;
        this.show_message("");
        this.controls?.set(this.settings);
    }

    private refuse(message: string, whole: boolean): void {
        this.asked = { ...this.asked, settings: this.settings, fault: this.fault };
        if (whole || !this.asked.by_controls) this.controls?.set(this.settings);
        if (!whole && !this.from_link) {
            if (this.asked.by_controls) this.controls?.refuse(message, this.settings);
            this.show_message(message);
            return;
        }
        this.client.send({ kind: "run", running: false });
        this.show_message(message, this.from_link ? "The link names no gyro. “Restart” begins the one before, or the default one." : "");
        this.refused = true;
        this.from_link = false;
        this.frames.forget();
        this.show_state("refused");
        marked("fingerprint").textContent = "";
    }

    private show_message(message: string, note = ""): void {
        element("note").textContent = note;
        element("note").hidden = note === "";
        marked("message").textContent = message;
        marked("message").hidden = message === "";
    }

    private show_state(state: State): void {
        marked("state").textContent = state;
        element("run").textContent = state === "running" ? "Pause" : state === "done" ? "Go on" : "Run";
        for (const id of ["run", "step-half", "step-tick"]) element<HTMLButtonElement>(id).disabled = state === "refused";
        element<HTMLButtonElement>("jump").disabled = state === "refused" || (this.frame !== null && !switches_again(this.frame));
    }

    private draw(frame: Frame): void {
        if (this.refused) return;
        this.frame = frame;
        // While a change is caught up with, the gyro is where it will be.
        if (!this.client.waits()) this.time_s = Math.max(frame.time_s, this.asked.from_s);
        marked("time").textContent = frame.time_s.toFixed(4);
        marked("fingerprint").textContent = frame.turned ? "turned by hand" : frame.fingerprint;
        document.documentElement.dataset.moduleBytes = String(frame.module_bytes);
        this.show_state(frame.state);
        this.views.show(frame);
        this.ring.show(frame);
        this.health?.show(frame.now[11], frame.raised);
        this.show_fault(frame);
    }

    private show_fault({ raised_since_fault, time_s }: Frame): void {
        const has_come = this.fault !== null && raised_since_fault !== null && time_s >= this.fault.at_s;
        const found = has_come ? this.health!.report(raised_since_fault!) || words_without_alarm(this.fault!, time_s) : "";
        const text = found && `Reported since the last fault: ${found}.`;
        if (element("fault-report").textContent !== text) element("fault-report").textContent = text;
    }

    // Settings that were changed while the gyro runs: as if it had always been so.
    private changed_by_hand(): void {
        this.begin(this.controls!.list(), { from_s: this.repeat_s(), by_controls: true });
    }

    private repeat_s(): number {
        return this.time_s <= longest_repeat_s ? this.time_s : 0;
    }

    private to_switch_s(at_s: number): number {
        // One that begins anew switches after an interval; 0 where it never switches, or its schedule is not known ahead.
        const wait_s = at_s > 0 ? this.frame?.now[10] : new Settings(this.keys, this.asked.settings).number("switching.interval_s");
        return wait_s !== undefined && wait_s > 0 && wait_s < never_s ? wait_s : 0;
    }

    private break_it(fault: Fault): void {
        const from_s = this.repeat_s();
        const to_switch_s = this.to_switch_s(from_s);
        this.begin(with_fault(this.asked.settings, fault, from_s, to_switch_s), { from_s, fault: made_fault(fault, from_s, to_switch_s) });
    }

    private send_speed(): void {
        const slider = element<HTMLInputElement>("speed");
        const at = Number(slider.value);
        const fastest = at >= Number(slider.max);
        const speed = fastest ? Infinity : Number((10 ** at).toPrecision(2));
        const text = fastest ? "as fast as it goes" : `${short(speed, 2)} ×`;
        element("speed-text").textContent = text;
        slider.setAttribute("aria-valuetext", text);
        this.client.send({ kind: "speed", speed });
    }

    private run_or_pause(): void {
        const state = this.frame?.state;
        if (state === "done") {
            this.wants_to_run = true;
            // Beyond the end of a link it goes on.
            this.begin(this.asked.settings, { from_s: this.time_s });
            return;
        }
        this.wants_to_run = state !== "running";
        this.client.send({ kind: "run", running: this.wants_to_run });
    }

    private step(halves: number): void {
        this.wants_to_run = false;
        this.client.send({ kind: "step", halves });
    }

    private jump(): void {
        this.wants_to_run = false;
        this.client.send({ kind: "jump" });
    }

    private listen(): void {
        const on_click = (id: string, action: () => void) => element(id).addEventListener("click", action);
        const buttons: [string, string, () => void][] = [
            ["run", " ", () => this.run_or_pause()],
            ["step-half", "h", () => this.step(1)],
            ["step-tick", "t", () => this.step(2)],
            ["jump", "n", () => this.jump()],
            ["restart", "0", () => this.begin(this.asked.settings)],
        ];
        for (const [id, , action] of buttons) on_click(id, action);
        document.addEventListener("keydown", (event) => {
            const place = event.target as HTMLElement;
            if (event.ctrlKey || event.metaKey || event.altKey || place.closest("input, select, textarea, button, summary, dialog") !== null) return;
            const button = buttons.find(([, key]) => key === event.key);
            if (button === undefined) return;
            event.preventDefault();
            element(button[0]).click();
        });
        element("speed").addEventListener("input", () => this.send_speed());
        element("window").addEventListener("change", () => this.client.send({ kind: "window", window_s: Number(element<HTMLSelectElement>("window").value) }));
        window.addEventListener("hashchange", () => this.open_link());
        choose_file(element("open-log"), element<HTMLInputElement>("log-file"), (file) => this.log.open(file));
        on_drop((file) => this.log.open(file));
        turn_by_hand((rate_arcsec_s) => this.client.send({ kind: "turn", rate_arcsec_s }));
        share_dialog(() => ({ settings: this.settings, time_s: this.time_s, turned: this.frame?.turned ?? false }));
    }
}

if (follows_records()) keep_charts();
else new Lab();

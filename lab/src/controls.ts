// Controls for the settings, made from the table of keys: the important ones first, all others by search.
import { made } from "./elements";
import type { Key } from "./protocol";

// In the order in which a newcomer meets them, in words of the trade.
const important = new Map([
    ["switching.interval_s", "From switch to switch"], ["motion.kind", "How the case is turned"], ["motion.amplitude_arcsec_s", "Amplitude of the oscillation"],
    ["motion.frequency_hz", "Its frequency"], ["motion.rate_arcsec_s", "Constant rate"], ["drift.magnetic_arcsec_s", "Magnetic drift at the start"],
    ["drift.magnetic_thermal_arcsec_s", "Its growth by warming"], ["drift.thermal_time_s", "Time constant of the warming"], ["drift.random_walk_arcsec_sqrt_s", "Random walk of the angle"],
    ["gyro.fidelity", "Model of the gyro"], ["compensation.relock", "Correction after closing the loop"], ["compensation.bridge", "What fills a gap"],
    ["compensation.magnetic", "Magnetic drift is"], ["perimeter.miss_lambda", "Detuning when the loop closes"], ["perimeter.tau_s", "Time constant of the loop"],
    ["perimeter.loop", "Control of the perimeter"], ["gyro.readout", "Readout of the beat"], ["gyro.light_noise_lambda", "Noise of a light sample"],
    ["piezo.half_wave_v", "Half-wave voltage"], ["run.seed", "Seed of all random numbers"],
]);
// A kind of motion that the page has not.
const recorded = '"file"';
const is_motion_kind = (key: Key) => key.section === "motion" && key.name === "kind";
// Of the laboratory's files and the designer's tables: they change nothing here.
const elsewhere = new Set(["design", "analysis"]);

export class Controls {
    private settings = new Map<string, string>(); // that differ from the defaults, as TOML: as the reader has asked for them
    private readonly refused = new Map<string, string>(); // of these, those that the gyro cannot have as yet, and why
    private of_gyro = new Map<string, string>();
    private without_refused = false; // what is asked for now
    private last_key = ""; // that was changed
    private timer = 0;

    constructor(
        private readonly place: HTMLElement,
        private readonly search: HTMLInputElement,
        private readonly keys: Key[],
        private readonly on_change: () => void,
    ) {
        this.search.addEventListener("input", () => this.draw());
        this.draw();
    }

    // What the gyro will have, if it can: the next change is made to these.
    expect(settings: string[]): void {
        this.settings = by_key(settings);
        this.of_gyro = by_key(settings);
        this.refused.clear();
    }

    // What the gyro has, `section.key=value` each. What it cannot have as yet waits for the reader's next change.
    set(settings: string[]): void {
        const waiting = this.without_refused ? [...this.refused].map(([key, message]) => ({ key, message, value: this.settings.get(key) })) : [];
        this.without_refused = false;
        this.expect(settings);
        for (const { key, message, value } of waiting) {
            this.put(key, value);
            this.refused.set(key, message);
        }
        if (!this.place.contains(document.activeElement)) this.draw();
        else this.mark();
    }

    // All that the reader wants; where that was refused, without what is to blame.
    list(): string[] {
        const kept = (key: string) => this.without_refused && this.refused.has(key);
        const asked = [...this.settings].filter(([key]) => !kept(key));
        return [...asked, ...[...this.of_gyro].filter(([key]) => kept(key))].map(([key, value]) => `${key}=${value}`);
    }

    // What was asked for was refused, and the gyro keeps what it has. Settings that are good together only may come one by one: all are tried
    // at each change, then those that no refusal has named.
    refuse(message: string, of_gyro: string[]): void {
        this.of_gyro = by_key(of_gyro);
        const asked = by_key(this.list());
        const changed = [...new Set([...asked.keys(), ...this.of_gyro.keys()])].filter((key) => asked.get(key) !== this.of_gyro.get(key));
        const had_refused = !this.without_refused && this.refused.size > 0;
        const fresh = changed.filter((key) => !this.refused.has(key));
        const named = fresh.filter((key) => message.includes(key));
        if (!had_refused) this.refused.set(named.includes(this.last_key) ? this.last_key : (named[0] ?? this.last_key), message);
        this.without_refused = fresh.some((key) => !this.refused.has(key));
        if (this.without_refused) this.on_change();
        this.mark();
    }

    private put(name: string, value: string | undefined): void {
        if (value === undefined) this.settings.delete(name);
        else this.settings.set(name, value);
    }

    private chosen(): [string, Key[]][] {
        const words = this.search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
        const usable = this.keys.filter((key) => !elsewhere.has(key.section) && key.kind !== "column");
        if (words.length === 0) {
            const found = [...important.keys()].map((name) => usable.find((key) => `${key.section}.${key.name}` === name)).filter((key) => key !== undefined);
            return [["", found]];
        }
        const sections = new Map<string, Key[]>();
        for (const key of usable) {
            const text = `${key.section}.${key.name} ${key.meaning} ${key.unit}`.toLowerCase();
            if (!words.every((word) => text.includes(word))) continue;
            sections.set(key.section, [...(sections.get(key.section) ?? []), key]);
        }
        return [...sections];
    }

    private draw(): void {
        this.place.replaceChildren();
        for (const [section, keys] of this.chosen()) {
            if (section) this.place.append(made("h3", `[${section}]`));
            for (const key of keys) this.place.append(this.control(key));
        }
        if (this.place.childElementCount === 0) this.place.append(made("p", "No setting has these words."));
        this.mark();
    }

    private control(key: Key): HTMLElement {
        const name = `${key.section}.${key.name}`;
        const box = made("div", "", { class: "control", "data-key": name });
        const id = `control-${name.replace(".", "-")}`;
        const words = important.get(name) ?? key.meaning.replace(/[;:].*/, "");
        const label = made("label", words, { for: id, title: name });
        if (key.unit) label.append(made("span", ` ${key.unit}`, { class: "unit" }));
        const value = this.settings.get(name) ?? key.default;
        const field = key.choices.length > 0 && key.kind !== "choices" ? choice(key, value) : text_field(value);
        field.id = id;
        field.setAttribute("aria-describedby", `${id}-help`);
        field.addEventListener("change", () => {
            if (field.value === "") field.value = bare(key, key.default);
            this.change(key, field.value);
        });
        if (field instanceof HTMLInputElement) field.addEventListener("input", () => this.change_soon(key, field.value));
        const reset = made("button", "↺", { type: "button", "aria-label": `${words}: back to the default` });
        reset.addEventListener("click", () => {
            field.value = bare(key, key.default);
            this.change(key, field.value);
        });
        // Who searches looks for names of a configuration as well; who does not is told nothing of them.
        const meaning = this.search.value === "" ? key.meaning.replace(/[;,][^;,]*[a-z][._][a-z].*/, "") : `${name}: ${key.meaning}`;
        const help = made("small", `${meaning}. Allowed: ${allowed_here(key)}`, { id: `${id}-help` });
        box.append(label, field, reset, help, made("small", "", { class: "wrong" }));
        return box;
    }

    // While it is typed, once it rests.
    private change_soon(key: Key, text: string): void {
        clearTimeout(this.timer);
        this.timer = window.setTimeout(() => this.change(key, text), 700);
    }

    private change(key: Key, text: string): void {
        clearTimeout(this.timer);
        const name = `${key.section}.${key.name}`;
        const before = this.settings.get(name) ?? bare(key, key.default);
        if (text === before) return;
        this.refused.delete(name);
        this.without_refused = false;
        this.last_key = name;
        this.put(name, text === "" || text === bare(key, key.default) ? undefined : text);
        this.on_change();
    }

    private mark(): void {
        for (const box of this.place.querySelectorAll<HTMLElement>(".control")) {
            const name = box.dataset.key!;
            box.classList.toggle("changed", this.settings.has(name));
            box.querySelector(".wrong")!.textContent = this.refused.get(name) ?? "";
        }
    }
}

// The best interval is found by trials, which the page does not make.
function allowed_here(key: Key): string {
    if (key.kind === "interval") return key.allowed.replace(/, or "optimal"$/, "");
    return is_motion_kind(key) ? key.allowed.replace(`, ${recorded}`, "") : key.allowed;
}

function by_key(settings: string[]): Map<string, string> {
    return new Map(settings.map((setting) => {
        const at = setting.indexOf("=");
        return [setting.slice(0, at), setting.slice(at + 1)];
    }));
}

// A text without its quotes.
function bare(key: Key, value: string): string {
    return key.kind === "choice" || key.kind === "optional_choice" || key.kind === "text" || key.kind === "interval" ? value.replace(/^"(.*)"$/, "$1") : value;
}

function text_field(value: string): HTMLInputElement {
    const field = document.createElement("input");
    field.type = "text";
    field.spellcheck = false;
    field.autocomplete = "off";
    field.placeholder = "unset";
    field.value = value;
    return field;
}

function choice(key: Key, value: string): HTMLSelectElement {
    const field = document.createElement("select");
    const choices = is_motion_kind(key) ? key.choices.filter((name) => `"${name}"` !== recorded) : key.choices;
    const names = key.kind === "optional_choice" ? ["", ...choices] : choices;
    for (const name of names) field.add(new Option(name === "" ? "unset" : name.replaceAll("_", " "), name));
    field.value = bare(key, value);
    return field;
}

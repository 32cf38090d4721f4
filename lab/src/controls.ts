// Controls for the settings, made from the table of keys: the important ones first, all others by search.
import { made } from "./elements";
import type { Key } from "./protocol";

// In the order in which a newcomer meets them.
const important = [
    "switching.interval_s", "motion.kind", "motion.amplitude_arcsec_s", "motion.frequency_hz", "motion.rate_arcsec_s",
    "drift.magnetic_arcsec_s", "drift.magnetic_thermal_arcsec_s", "drift.thermal_time_s", "drift.random_walk_arcsec_sqrt_s", "gyro.fidelity",
    "compensation.relock", "compensation.bridge", "compensation.magnetic", "perimeter.miss_lambda", "perimeter.tau_s",
    "perimeter.loop", "gyro.readout", "gyro.light_noise_lambda", "piezo.half_wave_v", "run.seed",
];
// A kind of motion that is chosen in the card of recorded motions.
const recorded = '"file"';
const is_motion_kind = (key: Key) => key.section === "motion" && key.name === "kind";
// Of the laboratory's files and the designer's tables: they change nothing here.
const elsewhere = new Set(["design", "analysis"]);

export class Controls {
    private settings = new Map<string, string>(); // that differ from the defaults, as TOML: as the reader has asked for them
    private wrong: { key: string; message: string; of_gyro: string | undefined } | null = null; // the one that was refused
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
        this.wrong = null;
    }

    // What the gyro has, `section.key=value` each.
    set(settings: string[]): void {
        this.expect(settings);
        if (!this.place.contains(document.activeElement)) this.draw();
        else this.mark();
    }

    list(): string[] {
        return [...this.settings].map(([key, value]) => `${key}=${value}`);
    }

    // What was asked for was refused, and the gyro keeps what it has. The wrong setting is taken back once the reader changes another one.
    refuse(message: string, of_gyro: string[]): void {
        const kept = by_key(of_gyro);
        const changed = [...new Set([...this.settings.keys(), ...kept.keys()])].filter((key) => this.settings.get(key) !== kept.get(key));
        const key = changed.find((name) => message.includes(name)) ?? this.last_key;
        this.wrong = { key, message, of_gyro: kept.get(key) };
        this.mark();
    }

    private take_back(name: string, value: string | undefined): void {
        if (value === undefined) this.settings.delete(name);
        else this.settings.set(name, value);
        const field = this.place.querySelector<HTMLInputElement | HTMLSelectElement>(`[data-key="${name}"] :is(input, select)`);
        const key = this.keys.find((each) => `${each.section}.${each.name}` === name);
        if (field !== null && key !== undefined) field.value = bare(key, value ?? key.default);
    }

    private chosen(): [string, Key[]][] {
        const words = this.search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
        const usable = this.keys.filter((key) => !elsewhere.has(key.section) && key.kind !== "column");
        if (words.length === 0) {
            const found = important.map((name) => usable.find((key) => `${key.section}.${key.name}` === name)).filter((key) => key !== undefined);
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
        const label = made("label", name, { for: id });
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
        const reset = made("button", "↺", { type: "button", "aria-label": `${name} back to its default` });
        reset.addEventListener("click", () => {
            field.value = bare(key, key.default);
            this.change(key, field.value);
        });
        const help = made("small", `${key.meaning}. Allowed: ${allowed_here(key)}`, { id: `${id}-help` });
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
        const is_other = this.wrong !== null && this.wrong.key !== name;
        if (text === before && !is_other) return;
        if (is_other) this.take_back(this.wrong!.key, this.wrong!.of_gyro);
        this.wrong = null;
        this.last_key = name;
        if (text === "" || text === bare(key, key.default)) this.settings.delete(name);
        else this.settings.set(name, text);
        this.on_change();
    }

    private mark(): void {
        for (const box of this.place.querySelectorAll<HTMLElement>(".control")) {
            const name = box.dataset.key!;
            box.classList.toggle("changed", this.settings.has(name));
            const message = this.wrong?.key === name ? this.wrong.message : "";
            box.querySelector(".wrong")!.textContent = message;
        }
    }
}

// The best interval is found by trials, which the page does not make.
function allowed_here(key: Key): string {
    if (key.kind === "interval") return `${key.allowed.replace(/, or "optimal"$/, "")}; the best one stands in “How often to switch”`;
    return is_motion_kind(key) ? key.allowed.replace(`, ${recorded}`, "; for a file, “Recorded motions”") : key.allowed;
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
    const choices = is_motion_kind(key) && value !== recorded ? key.choices.filter((name) => `"${name}"` !== recorded) : key.choices;
    const names = key.kind === "optional_choice" ? ["", ...choices] : choices;
    for (const name of names) field.add(new Option(name === "" ? "unset" : name, name));
    field.value = bare(key, value);
    return field;
}

// The page of `zlg lab --follow`: what a gyro gives now, in place of the simulated one.
import { finite, made, marked } from "./elements";
import { HealthList } from "./health";
import { Chart, short } from "./plots";
import { Ring } from "./series";

const newest_rows = 32768;
const most_points = 1200;
const most_history = 2048;
const shortest_step_s = 0.25; // of the history
const silent_from_s = 3;
const again_ms = 2000;

// Columns of the rows that are kept.
const at = { time: 0, rate: 1, detuning: 2, piezo: 3, mode: 4, angle: 5 };
const n_columns = 6;

type Row = (number | null)[]; // as record_book.hpp has it
interface Gap {
    first: number;
    ticks: number;
    shown: number;
    mode: number;
    dtheta: number[];
    final: number[];
}
interface News {
    tick_s: number | null;
    first: number;
    rows: Row[];
    ended: boolean;
    since_start: { flags: number; health: number };
    gap?: Gap;
    allan?: [number[], number[]];
}
interface Snapshot extends News {
    source: string;
    flag_names: string[];
    health_names: string[];
    history: [number[], number[]];
}

// The angle since the start, with fewer points the older it is.
class History {
    times: number[] = [];
    angles: number[] = [];
    private step_s = shortest_step_s;

    begin([times, angles]: [number[], number[]]): void {
        this.times = [...times];
        this.angles = [...angles];
        this.step_s = Math.max(shortest_step_s, (times[1] ?? 0) - (times[0] ?? 0));
    }

    add(time_s: number, angle: number): void {
        if (time_s < (this.times.at(-1) ?? -Infinity) + this.step_s) return;
        this.times.push(time_s);
        this.angles.push(angle);
        if (this.times.length <= most_history) return;
        this.times = this.times.filter((_, k) => k % 2 === 0);
        this.angles = this.angles.filter((_, k) => k % 2 === 0);
        this.step_s *= 2;
    }
}

function card(title: string, ...content: HTMLElement[]): HTMLElement {
    const section = made("section", "", { class: "card", "aria-label": title });
    section.append(made("h2", title), ...content);
    return section;
}

function column(...cards: HTMLElement[]): HTMLElement {
    const place = made("div", "", { class: "column" });
    place.append(...cards);
    return place;
}

const plot = () => made("div", "", { class: "plot" });

class LivePage {
    private readonly rows = new Ring(n_columns, newest_rows);
    private readonly history = new History();
    private next = -1; // row
    private tick_s = 0;
    private newest: Row | null = null;
    private gap: Gap | null = null;
    private allan: [number[], number[]] = [[], []];
    private since_start = { flags: 0, health: 0 };
    private is_to_be_drawn = false;
    private is_live = false;
    private record_ms = 0; // when the last one came

    private readonly values = made("dl", "", { class: "values" });
    private readonly health_place = made("ul", "", { class: "health" });
    private readonly flags_place = made("ul", "", { class: "health" });
    private readonly gap_text = made("p", "No gap yet.");
    private readonly window_s = made("select", "", { id: "window" });
    private readonly places = { angle: plot(), rate: plot(), detuning: plot(), piezo: plot(), mode: plot(), gap: plot(), allan: plot() };
    private readonly charts: Record<keyof LivePage["places"], Chart>;
    private readonly health_card = card("Health", made("p", "What the gyro has reported of itself since the start."), this.health_place);
    private health: HealthList | null = null;
    private flags: HealthList | null = null;

    constructor(private readonly address: string) {
        this.build();
        const chart = (place: keyof LivePage["places"], y: string, label: string, unit: string, more: object = {}) =>
            new Chart(this.places[place], { x: "time, s", y, height: 170, lines: [{ label, colour: "--ours", unit, digits: 7 }], ...more });
        const signal = { sync: "signals" };
        this.charts = {
            angle: chart("angle", "angle, arcsec", "angle since the start", "arcsec", { height: 240 }),
            rate: chart("rate", "rate, arcsec/s", "rate, best value", "arcsec/s", { ...signal, least_span: 1 }),
            detuning: chart("detuning", "detuning, λ", "detuning of the perimeter", "λ", { ...signal, least_span: 0.05 }),
            piezo: chart("piezo", "piezo, V", "voltage at the piezo mirrors", "V", { ...signal, least_span: 4 }),
            mode: chart("mode", "mode", "mode; 0: loop open", "", { ...signal, height: 110, y_range: [-1.3, 1.3], y_splits: [-1, 0, 1] }),
            gap: new Chart(this.places.gap, { x: "ticks since the loop was opened", y: "rate, arcsec/s", height: 240, lines: [{ label: "in real time", colour: "--paper", unit: "arcsec/s", points: true }, { label: "best value", colour: "--ours", unit: "arcsec/s", points: true }] }),
            allan: new Chart(this.places.allan, { x: "averaging time, s", y: "deviation, deg/h", height: 220, log_x: true, log_y: true, lines: [{ label: "best value", colour: "--ours", unit: "deg/h", points: true }] }),
        };
        this.listen();
        setInterval(() => this.watch(), 1000);
    }

    // The cards of the simulated gyro give way.
    private build(): void {
        for (const name of [".tools", ".buttons", ".speed", ".mark", "#note"]) document.querySelector<HTMLElement>(name)?.setAttribute("hidden", "");
        for (const seconds of ["1", "5", "30", "150"]) this.window_s.append(made("option", `${seconds} s`, { value: seconds }));
        this.window_s.value = "5";
        this.window_s.addEventListener("change", () => this.draw_soon());
        const choice = made("label", "Window ", { class: "window" });
        choice.append(this.window_s);
        const { places } = this;
        document.querySelector("main")!.replaceChildren(
            column(card("The gyro now", this.values), this.health_card, card("Flags of the ticks", made("p", "Raised since the start."), this.flags_place)),
            column(card("Angle", places.angle), card("Signals", choice, places.rate, places.detuning, places.piezo, places.mode), card("The last gap, magnified", this.gap_text, places.gap), card("Allan deviation", made("p", "Of the rate, its turns included."), places.allan)),
        );
        document.querySelector("footer p")!.textContent = "The records come from zlg on this machine; no other request leaves this page.";
        this.say("waiting");
    }

    private say(state: string): void {
        marked("state").textContent = state;
    }

    private listen(): void {
        const source = new EventSource(this.address);
        const take = (event: MessageEvent<string>) => {
            const news = JSON.parse(event.data) as News | Snapshot;
            if ("source" in news) this.begin(news);
            // Should anything be missing, a new connection begins with a snapshot.
            if (news.first > this.next) {
                source.close();
                this.listen();
            } else {
                this.take(news);
            }
        };
        source.addEventListener("snapshot", take);
        source.addEventListener("rows", take);
        source.onerror = () => {
            this.is_live = false;
            this.say("connection lost, trying again");
            // The browser tries again by itself, unless it was refused.
            if (source.readyState === EventSource.CLOSED) setTimeout(() => this.listen(), again_ms);
        };
    }

    private begin(snapshot: Snapshot): void {
        document.title = `zlg lab: ${snapshot.source}`;
        document.querySelector(".what")!.textContent = `Live, from ${snapshot.source}`;
        this.rows.clear();
        this.history.begin(snapshot.history);
        this.next = snapshot.first;
        this.newest = null;
        this.gap = null;
        this.health_card.hidden = snapshot.health_names.length === 0;
        this.health = new HealthList(this.health_place, snapshot.health_names);
        this.flags = new HealthList(this.flags_place, snapshot.flag_names);
    }

    private take(news: News): void {
        this.tick_s = news.tick_s ?? 0;
        for (const row of news.rows.slice(Math.max(0, this.next - news.first))) this.add(row);
        this.gap = news.gap ?? this.gap;
        this.allan = news.allan ?? this.allan;
        this.since_start = news.since_start;
        if (news.rows.length > 0) this.record_ms = performance.now();
        this.is_live = !news.ended && this.newest !== null;
        this.say(news.ended ? "the source has ended" : this.is_live ? "live" : "waiting");
        this.draw_soon();
    }

    // A gyro that is silent, and a log that nobody writes any more, look the same to the server.
    private watch(): void {
        const silent_s = Math.floor((performance.now() - this.record_ms) / 1000);
        if (this.is_live && silent_s >= silent_from_s) this.say(`no record for ${silent_s} s`);
    }

    private add(row: Row): void {
        const [, final, , mode, flags, angle, detuning, piezo] = row;
        const time_s = ++this.next * this.tick_s;
        const open = ((flags ?? 0) & 0x300) !== 0; // loop_unlocked, invalid
        this.rows.add(Float64Array.of(time_s, (final ?? NaN) / this.tick_s, detuning ?? NaN, piezo ?? NaN, open ? 0 : (mode ?? 0), angle ?? NaN));
        this.history.add(time_s, angle ?? NaN);
        this.newest = row;
    }

    // A hidden page draws when it is shown again.
    private draw_soon(): void {
        if (this.is_to_be_drawn) return;
        this.is_to_be_drawn = true;
        requestAnimationFrame(() => {
            this.is_to_be_drawn = false;
            this.draw();
        });
    }

    private draw(): void {
        marked("time").textContent = (Math.max(0, this.next) * this.tick_s).toFixed(4);
        this.draw_angle();
        this.draw_signals();
        this.draw_gap();
        this.charts.allan.show(this.allan);
        if (this.newest === null) return;
        this.flags?.show(this.newest[4] ?? 0, { settled: 0, switching: this.since_start.flags });
        this.health?.show(this.newest[9] ?? 0, { settled: 0, switching: this.since_start.health });
        this.draw_values(this.newest);
    }

    // What is kept in full is drawn from that, what came before from the history.
    private draw_angle(): void {
        const shown = this.rows.slice(this.rows.first, this.rows.end, most_points, at.angle);
        const { times, angles } = this.history;
        const before = times.findIndex((time_s) => time_s >= (shown[at.time][0] ?? Infinity));
        const n = before < 0 ? times.length : before;
        this.charts.angle.show([[...times.slice(0, n), ...shown[at.time]], [...angles.slice(0, n), ...Array.from(shown[at.angle], finite)]]);
    }

    private draw_signals(): void {
        const { end } = this.rows;
        const ticks = this.tick_s > 0 ? Math.round(Number(this.window_s.value) / this.tick_s) : 0;
        const shown = this.rows.slice(end - ticks, end, most_points, at.rate);
        for (const name of ["rate", "detuning", "piezo", "mode"] as const) {
            const values = Array.from(shown[at[name]], finite);
            this.places[name].hidden = values.every((value) => value === null) && values.length > 0;
            this.charts[name].show([shown[at.time], values]);
        }
    }

    private draw_gap(): void {
        if (this.gap === null) return;
        const { first, ticks, shown, mode, dtheta, final } = this.gap;
        const rates = (increments: number[]) => increments.map((increment) => increment / this.tick_s);
        this.charts.gap.show([dtheta.map((_, k) => shown + k - first), rates(dtheta), rates(final)]);
        this.gap_text.textContent = `At ${short(first * this.tick_s, 6)} s nothing was measured for ${ticks} ticks (${short(ticks * this.tick_s * 1000)} ms); mode ${mode > 0 ? "+1" : "−1"} after it.`;
    }

    private draw_values(row: Row): void {
        const [, final, sigma, mode, , angle, detuning, piezo, temperature] = row;
        const shown: [string, number | null, string][] = [
            ["Rate", final === null ? null : final / this.tick_s, "arcsec/s"],
            ["Angle", angle, "arcsec"],
            ["Sigma of a tick", sigma, "arcsec"],
            ["Mode", mode, ""],
            ["Detuning", detuning, "λ"],
            ["Piezo", piezo, "V"],
            ["Temperature", temperature, "°C"],
        ];
        this.values.replaceChildren(
            ...shown.filter(([, value]) => value !== null).flatMap(([name, value, unit]) => [made("dt", name), made("dd", `${short(value!, 6)} ${unit}`)]),
        );
    }
}

// Where the program serves this page, it says so in its head; true: then the page shows records.
export function follows_records(): boolean {
    const said = document.querySelector<HTMLMetaElement>('meta[name="zlg-records"]');
    if (said !== null) new LivePage(said.content);
    return said !== null;
}

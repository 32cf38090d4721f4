// A recorded motion in text: a row of names, then rows of numbers, of which one column is the time in seconds and one a rate.

export interface Motion {
    values: Float64Array; // of the column, as they stand there
    settings: string[]; // with which `zlg run` reads the same file
    note: string; // what was taken for what
}

const time_names = /^(t|time|seconds)(_s)?( ?\[s\])?$/i;
// Rates by the ends of their names, arcsec/s for one of their unit. A letter before the unit makes another one of it: mdeg_s, grad_s.
const units: [RegExp, string, number][] = [
    [/(^|[^a-z])(arcsec[_/]s|deg[_/]h)\]?$/i, "arcsec/s", 1],
    [/(^|[^a-z])(deg[_/]s|dps)\]?$/i, "deg/s", 3600],
    [/(^|[^a-z])rad[_/]s\]?$/i, "rad/s", (180 * 3600) / Math.PI],
];
const decimal_number = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
const most_bytes = 64 << 20;
const shortest_rows = 2;

// Throws an Error whose message names the file, and the line where it is of one.
export async function read_motion(file: File): Promise<Motion> {
    if (file.size > most_bytes) throw new Error(`${file.name}: ${file.size} bytes; allowed for a motion are ${most_bytes}`);
    return parse_motion(file.name, await file.text());
}

function parse_motion(name: string, text: string): Motion {
    const lines = text.replace(/^\uFEFF/, "").split(/\r?\n/);
    let at = 0;
    while (at < lines.length && (lines[at].trim() === "" || lines[at].startsWith("#"))) ++at;
    const split = splitter(lines[at] ?? "");
    const names = split(lines[at] ?? "");
    const time_column = names.findIndex((each) => time_names.test(each));
    if (time_column < 0) throw new Error(`${name}: has no column of times; allowed is a line of names with one of t, t_s, time, time_s above the numbers`);
    const found = names.map((each) => units.find(([ending]) => ending.test(each)));
    const column = found.findIndex((unit, k) => unit !== undefined && k !== time_column);
    if (column < 0) throw new Error(`${name}: has no column of rates; allowed is a name that ends with its unit: _arcsec_s, _deg_s, _dps, _deg_h or _rad_s`);
    if (names.indexOf(names[column]) !== names.lastIndexOf(names[column])) throw new Error(`${name}: two columns are named '${names[column]}'; allowed is one`);
    const { times, values } = columns(name, lines, at + 1, split, names, time_column, column);
    const rate_hz = even_rate_hz(name, times);
    const [, unit, scale] = found[column]!;
    return {
        values: Float64Array.from(values),
        settings: ['motion.kind="file"', `motion.path=${JSON.stringify(name)}`, `motion.column=${JSON.stringify(names[column])}`, 'motion.column_holds="rate"', `motion.scale_arcsec=${scale}`, `motion.rate_hz=${rate_hz}`],
        note: `${name}: ${values.length} rows of “${names[column]}” in ${unit}, ${rate_hz} a second, ${Number((values.length / rate_hz).toPrecision(6))} s`,
    };
}

// By the separator that the names have.
function splitter(names: string): (line: string) => string[] {
    const separator = [",", ";", "\t"].find((each) => names.includes(each));
    return (line) => (separator === undefined ? line.trim().split(/\s+/) : line.split(separator)).map((field) => field.trim().replace(/^"(.*)"$/, "$1"));
}

function columns(name: string, lines: string[], from: number, split: (line: string) => string[], names: string[], time_column: number, column: number): { times: number[]; values: number[] } {
    const [times, values]: [number[], number[]] = [[], []];
    for (let at = from; at < lines.length; ++at) {
        if (lines[at].trim() === "" || lines[at].startsWith("#")) continue;
        const fields = split(lines[at]);
        const row = values.length + 1;
        if (fields.length !== names.length) throw new Error(`${name}:${at + 1}, row ${row}: ${fields.length} fields, where the column names are ${names.length}`);
        for (const [k, place] of [[time_column, times], [column, values]] as const) {
            const value = decimal_number.test(fields[k]) ? Number(fields[k]) : NaN;
            if (!Number.isFinite(value)) throw new Error(`${name}:${at + 1}, row ${row}, column '${names[k]}': '${fields[k].slice(0, 40)}' is no finite number`);
            place.push(value);
        }
    }
    if (values.length < shortest_rows) throw new Error(`${name}: ${values.length} rows; allowed are ${shortest_rows} or more`);
    return { times, values };
}

// Rows a second; no step of the times may be off the middle one by half of it, and no time off its place by half a step.
function even_rate_hz(name: string, times: number[]): number {
    const steps = times.slice(1).map((time, row) => time - times[row]);
    const step = [...steps].sort((a, b) => a - b)[steps.length >> 1];
    if (!(step > 0)) throw new Error(`${name}: its times do not rise`);
    const off = steps.findIndex((each) => !(Math.abs(each - step) < 0.5 * step));
    if (off >= 0) throw new Error(`${name}, row ${off + 2}: the time ${times[off + 1]} s comes ${Number(steps[off].toPrecision(6))} s after the one before, others ${Number(step.toPrecision(6))} s; a motion has no holes`);
    const exact_hz = steps.length / (times[steps.length] - times[0]);
    const late = times.findIndex((time, row) => !(Math.abs(time - (times[0] + row / exact_hz)) < 0.5 * step));
    if (late >= 0) throw new Error(`${name}, row ${late + 1}: the time ${times[late]} s is ${Number((times[late] - times[0] - late / exact_hz).toPrecision(3))} s off the even steps from the first row to the last; allowed is half a step`);
    const whole_hz = Math.round(exact_hz);
    return Math.abs(whole_hz - exact_hz) < 1e-6 * exact_hz ? whole_hz : Number(exact_hz.toPrecision(9));
}

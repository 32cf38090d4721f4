// Numbers that grow without end, in bounded memory.

// The newest rows of a flat table.
export class Ring {
    private readonly numbers: Float64Array;
    private n = 0; // rows that were ever added

    constructor(
        private readonly columns: number,
        private readonly capacity: number,
    ) {
        this.numbers = new Float64Array(columns * capacity);
    }

    add(rows: Float64Array): void {
        const count = rows.length / this.columns;
        for (let row = Math.max(0, count - this.capacity); row < count; ++row) {
            const place = ((this.n + row) % this.capacity) * this.columns;
            this.numbers.set(rows.subarray(row * this.columns, (row + 1) * this.columns), place);
        }
        this.n += count;
    }

    clear(): void {
        this.n = 0;
    }

    get first(): number {
        return Math.max(0, this.n - this.capacity);
    }

    get end(): number {
        return this.n;
    }

    at(row: number, column: number): number {
        return this.numbers[(row % this.capacity) * this.columns + column];
    }

    // Rows [from, to) in columns. More than `most` rows are thinned: of each run of rows, the two with the least and the greatest
    // value of the column `shape`, so that no short peak is lost.
    slice(from: number, to: number, most: number, shape: number): Float64Array[] {
        const begin = Math.max(from, this.first);
        const end = Math.min(to, this.n);
        const rows: number[] = [];
        const stride = Math.max(1, Math.ceil((2 * (end - begin)) / most));
        // Runs begin at whole multiples of their length: a row that stays in view is then shown or not, and does not flicker.
        for (let at = begin - (begin % stride); at < end; at += stride) {
            const last = Math.min(at + stride, end);
            let least = Math.max(at, begin);
            let greatest = least;
            for (let row = least; row < last; ++row) {
                if (this.at(row, shape) < this.at(least, shape)) least = row;
                if (this.at(row, shape) > this.at(greatest, shape)) greatest = row;
            }
            if (least === greatest) rows.push(least);
            else rows.push(Math.min(least, greatest), Math.max(least, greatest));
        }
        return Array.from({ length: this.columns }, (_, column) => Float64Array.from(rows, (row) => this.at(row, column)));
    }
}

// A whole run in a bounded number of stretches of equal length, each with the least and the greatest value of every column, so that
// no peak is lost. The length is doubled whenever the table is full.
export class Envelope {
    private stretches: { at: number; least: number[]; greatest: number[] }[] = [];
    private length = 1; // rows of a stretch
    private n = 0;

    constructor(private readonly capacity: number) {}

    add(at: number, values: number[]): void {
        if (this.n++ % this.length === 0) {
            if (this.stretches.length === this.capacity) this.halve();
            this.stretches.push({ at, least: [...values], greatest: [...values] });
            return;
        }
        widen(this.stretches[this.stretches.length - 1], values, values);
    }

    private halve(): void {
        this.stretches = this.stretches.filter((stretch, index) => {
            if (index % 2 === 0) return true;
            widen(this.stretches[index - 1], stretch.least, stretch.greatest);
            return false;
        });
        this.length *= 2;
    }

    // First `at` of each stretch, then the columns: least and greatest value one behind the other.
    columns(count: number): Float64Array[] {
        const each = this.length === 1 ? 1 : 2;
        const n = this.stretches.length * each;
        const column = (value: (stretch: { at: number; least: number[]; greatest: number[] }, end: number) => number) => Float64Array.from({ length: n }, (_, k) => value(this.stretches[Math.floor(k / each)], k % each));
        const step = (this.stretches[1]?.at ?? 0) - (this.stretches[0]?.at ?? 0);
        return [column((stretch, end) => stretch.at + 0.5 * end * step), ...Array.from({ length: count }, (_, k) => column((stretch, end) => (end === 0 ? stretch.least[k] : stretch.greatest[k])))];
    }
}

// NaN is no value.
function widen(stretch: { least: number[]; greatest: number[] }, least: number[], greatest: number[]): void {
    for (let k = 0; k < least.length; ++k) {
        if (!(stretch.least[k] <= least[k]) && !Number.isNaN(least[k])) stretch.least[k] = least[k];
        if (!(stretch.greatest[k] >= greatest[k]) && !Number.isNaN(greatest[k])) stretch.greatest[k] = greatest[k];
    }
}

// Averaging times, and the deviations of each.
export function allan_columns(deviations: AllanDeviation[]): Float64Array[] {
    const points = deviations.map((deviation) => deviation.points());
    return [points[0][0], ...points.map(([, values]) => values)].map((values) => Float64Array.from(values));
}

// Allan deviation of an angle that grows tick by tick, for averaging times of T, 2T, 4T ...:
//
//   sigma^2(tau) = <(theta[k+2] - 2 theta[k+1] + theta[k])^2> / (2 tau^2)      theta at multiples of tau
//
// (Allan 1966, without overlap: one sum a time, and no record is kept.)
export class AllanDeviation {
    private levels: { n: number; sum: number; before: number[] }[] = [];
    private tick = 0;

    constructor(private readonly tick_s: number) {}

    // The angle after the next tick; the first call is tick 0.
    add(angle: number): void {
        for (let level = 0, multiple = this.tick; ; ++level, multiple /= 2) {
            if (level === this.levels.length) this.levels.push({ n: 0, sum: 0, before: [] });
            const at = this.levels[level];
            if (at.before.length === 2) {
                at.sum += (angle - 2 * at.before[1] + at.before[0]) ** 2;
                ++at.n;
                at.before.shift();
            }
            at.before.push(angle);
            if (multiple === 0 || multiple % 2 !== 0) break;
        }
        ++this.tick;
    }

    // Averaging times with at least `least` differences, and the deviations there.
    points(least = 3): [number[], number[]] {
        const taus: number[] = [];
        const deviations: number[] = [];
        this.levels.forEach((at, level) => {
            if (at.n < least) return;
            const tau = this.tick_s * 2 ** level;
            taus.push(tau);
            deviations.push(Math.sqrt(at.sum / at.n / 2) / tau);
        });
        return [taus, deviations];
    }
}

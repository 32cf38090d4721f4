// The worker's picture of the last switch: the rates tick by tick around each gap.
import type { SwitchPicture } from "./protocol";
import type { Ring } from "./series";

const ticks_around = 12;
const longest_relock_ticks = 40; // that is shown

export interface SwitchFacts {
    first_tick: number;
    gap_ticks: number;
    last_tick: number; // of the re-lock
    mode_after: number;
    cost_arcsec: number;
}

// Columns of the table of increments; null: it has none.
export interface IncrementColumns {
    true: number | null;
    read: number;
    delivered: number;
    final: number;
}

export class SwitchPictures {
    private waiting: SwitchFacts[] = []; // whose ticks after the re-lock have not all come
    private newest: SwitchPicture | null = null;

    // ring  increments, whose row is that of their tick's number.
    constructor(
        private readonly ring: Ring,
        private readonly columns: IncrementColumns,
        private readonly tick_s: number,
    ) {}

    expect(facts: SwitchFacts): void {
        this.waiting.push(facts);
        this.draw(facts);
    }

    // After more rows.
    settle(at_end = false): void {
        while (this.waiting.length > 0 && (at_end || this.ring.end >= last_shown(this.waiting[0]))) this.draw(this.waiting.shift()!);
    }

    // The last that was drawn since this was asked last; one may come twice, the second time whole.
    take(): SwitchPicture | null {
        const found = this.newest;
        this.newest = null;
        return found;
    }

    private draw(facts: SwitchFacts): void {
        const [first, end] = [facts.first_tick - ticks_around, last_shown(facts)];
        const rows = this.ring.slice(first, end, Infinity, 0);
        const rates = (column: number | null) => (column === null ? new Float64Array(rows[0].length).fill(NaN) : rows[column].map((increment) => increment / this.tick_s));
        const ticks = rows[0].map((tick) => tick - facts.first_tick);
        // What was extrapolated and interpolated is of interest within the gap and beside it.
        const near = (column: number) => rates(column).map((rate, row) => (ticks[row] >= -1 && ticks[row] <= facts.gap_ticks ? rate : NaN));
        this.newest = { ...facts, at_s: facts.first_tick * this.tick_s, gap_s: facts.gap_ticks * this.tick_s, columns: [ticks, rates(this.columns.true), rates(this.columns.read), near(this.columns.delivered), near(this.columns.final)] };
    }
}

function last_shown(facts: SwitchFacts): number {
    return Math.min(facts.last_tick, facts.first_tick + facts.gap_ticks + longest_relock_ticks) + ticks_around;
}

// Charts of the page, by uPlot: colours from the style sheet, as wide as their place.
import uPlot from "uplot";

export interface Line {
    label: string;
    colour: string; // a custom property of the style sheet
    unit: string;
    digits?: number;
    dash?: number[];
    bars?: boolean;
    steps?: boolean;
    points?: boolean;
}

export interface ChartOptions {
    x: string; // name of the axis, with its unit
    y: string;
    lines: Line[];
    height: number;
    log_x?: boolean;
    log_y?: boolean;
    y_range?: [number, number];
    y_splits?: number[];
    least_span?: number; // of the y axis: noise within it is not blown up to the whole height
    x_names?: string[]; // in place of numbers 0, 1, 2 ...
    sync?: string;
}

const charts = new Map<Element, Chart>();

// Most charts are above or below what is seen.
const views = new IntersectionObserver((entries) => {
    for (const entry of entries) charts.get(entry.target)?.see(entry.isIntersecting);
}, { rootMargin: "200px" });

function style_value(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// A number with so many significant digits, without an exponent where it can be.
export function short(value: number, digits = 4): string {
    if (!Number.isFinite(value)) return "–";
    const text = Math.abs(value) >= 1e7 || (value !== 0 && Math.abs(value) < 1e-4) ? value.toExponential(Math.min(2, digits - 1)) : String(Number(value.toPrecision(digits)));
    return text.replace("-", "−");
}

function is_power_of_ten(value: number): boolean {
    return Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9;
}

function wide_enough(least_span: number): (_: uPlot, min: number | null, max: number | null) => uPlot.Range.MinMax {
    return (_, min, max) => {
        if (min === null || max === null) return [0, least_span];
        const middle = 0.5 * (min + max);
        const half = Math.max(0.55 * (max - min), 0.5 * least_span);
        return [middle - half, middle + half];
    };
}

export class Chart {
    private plot: uPlot | null = null;
    private data: uPlot.AlignedData;
    private is_empty = true;
    private is_in_view = false;
    private is_drawn = false;

    constructor(
        private readonly place: HTMLElement,
        private readonly options: ChartOptions,
    ) {
        this.data = [[], ...options.lines.map(() => [])] as unknown as uPlot.AlignedData;
        this.place.setAttribute("role", "img");
        this.place.setAttribute("aria-label", `Chart: ${options.lines.map((line) => line.label).join(", ")} over ${options.x}`);
        this.make();
        charts.set(this.place, this);
        views.observe(this.place);
    }

    // Drawn when it is in view.
    show(columns: ArrayLike<number | null>[]): void {
        this.data = columns as unknown as uPlot.AlignedData;
        this.is_drawn = false;
        this.draw();
    }

    see(is_in_view: boolean): void {
        this.is_in_view = is_in_view;
        this.draw();
    }

    private draw(): void {
        if (this.is_drawn || !this.is_in_view) return;
        this.is_drawn = true;
        const was_empty = this.is_empty;
        this.is_empty = this.data[0].length === 0;
        // Without data the axes would stay those of the gyro before.
        if (this.is_empty && !was_empty) this.make();
        else this.plot?.setData(this.data);
    }

    make(): void {
        const options = this.uplot_options();
        // What the reader has hidden stays hidden.
        this.plot?.series.forEach((line, at) => (options.series[at].show = line.show));
        this.plot?.destroy();
        this.plot = new uPlot(options, this.data, this.place);
        this.is_drawn = true;
    }

    resize(): void {
        this.plot?.setSize({ width: this.place.clientWidth, height: this.options.height });
    }

    private uplot_options(): uPlot.Options {
        const { options } = this;
        const axis = { stroke: style_value("--soft"), grid: { stroke: style_value("--grid"), width: 1 }, ticks: { stroke: style_value("--line"), width: 1 }, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelSize: 18, labelGap: 0 };
        const named = options.x_names;
        const plain = (_: uPlot, values: (number | null)[]) => values.map((value) => (value === null ? "" : short(value)));
        // A long number would be cut off at the end of the axis.
        const wide = (_: uPlot, values: (number | null)[]) => values.map((value) => (value === null ? "" : value >= 1e5 ? value.toExponential(0).replace("+", "") : short(value)));
        const decades = (_: uPlot, values: (number | null)[]) => values.map((value) => (value !== null && is_power_of_ten(value) ? short(value) : ""));
        return {
            width: Math.max(this.place.clientWidth, 200),
            height: options.height,
            pxAlign: 0,
            cursor: { drag: { x: false, y: false }, ...(options.sync ? { sync: { key: options.sync } } : {}) },
            legend: { live: true, markers: { width: 2 } },
            scales: {
                x: { time: false, distr: options.log_x ? 3 : 1, ...(named ? { range: [-0.6, named.length - 0.4] } : {}) },
                y: { distr: options.log_y ? 3 : 1, ...(options.y_range ? { range: options.y_range } : options.least_span ? { range: wide_enough(options.least_span) } : {}) },
            },
            axes: [
                { ...axis, label: options.x, size: 34, ...(named ? { splits: () => named.map((_, at) => at), values: (_: uPlot, at: number[]) => at.map((k) => named[k] ?? "") } : { values: options.log_x ? wide : plain }) },
                { ...axis, label: options.y, size: 70, ...(options.y_splits ? { splits: () => options.y_splits! } : {}), values: options.log_y ? decades : plain },
            ],
            series: [
                { label: options.x.split(",")[0], value: (_, value) => (value === null ? "" : named ? (named[Math.round(value)] ?? "") : short(value, 6)) },
                ...options.lines.map((line): uPlot.Series => {
                    const colour = style_value(line.colour);
                    return {
                        label: line.label,
                        stroke: colour,
                        width: 1.5,
                        dash: line.dash,
                        spanGaps: false,
                        value: (_, value) => (value === null || value === undefined ? "" : `${short(value, line.digits ?? 4)} ${line.unit}`),
                        points: { show: line.points ?? false, size: 5 },
                        ...(line.steps ? { paths: uPlot.paths.stepped!({ align: -1 }) } : {}),
                        ...(line.bars ? { paths: uPlot.paths.bars!({ size: [0.85, 40] }), fill: `${colour}55` } : {}),
                    };
                }),
            ],
        };
    }
}

// The charts follow the width of the page and the scheme of its colours.
export function keep_charts(): void {
    let waiting = 0;
    window.addEventListener("resize", () => {
        cancelAnimationFrame(waiting);
        waiting = requestAnimationFrame(() => charts.forEach((chart) => chart.resize()));
    });
    window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => charts.forEach((chart) => chart.make()));
}

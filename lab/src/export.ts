// What can be taken along: configuration, numbers, a picture.
import { compensations } from "./compensations";
import { element } from "./elements";
import type { Columns, Frame } from "./protocol";

const signal_names = ["t_s", "true_arcsec_s", "measured_arcsec_s", "detuning_lambda", "piezo_v", "light_a", "light_b", "mode", "loop_closed", "valid", "bias_hz", "health"];
const error_names = ["t_s", "as_read_arcsec", "paper_arcsec", "configured_arcsec", "second_gyro_arcsec"];
const error_curves = [...compensations.map(({ label, print }) => [label, print]), ["second gyro", "#5d6672"]];

export function save(name: string, type: string, text: string | Blob): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// A file for `zlg run`: what differs from the defaults, section by section.
function toml(settings: string[]): string {
    const sections = new Map<string, string[]>();
    for (const setting of settings) {
        const at = setting.indexOf("=");
        const [section, name] = setting.slice(0, at).split(".");
        sections.set(section, [...(sections.get(section) ?? []), `${name} = ${setting.slice(at + 1)}`]);
    }
    return [...sections].map(([section, lines]) => `[${section}]\n${lines.join("\n")}\n`).join("\n");
}

function csv(names: string[], columns: Columns): string {
    const rows = Array.from(columns[0] ?? [], (_, row) => columns.map((column) => column[row]).join(","));
    return `${[names.join(","), ...rows].join("\n")}\n`;
}

interface Drawn {
    name: string;
    colour: string;
    values: ArrayLike<number>;
}

// Curves over one axis, with their legend, on white.
function svg(x_name: string, y_name: string, x: ArrayLike<number>, curves: Drawn[]): string {
    const [width, height, left, bottom, top] = [760, 420, 80, 50, 40];
    const drawn = curves.filter((curve) => Array.from(curve.values).some(Number.isFinite));
    const all = drawn.flatMap((curve) => Array.from(curve.values).filter(Number.isFinite));
    const [y0, y1] = all.length > 0 ? [Math.min(...all), Math.max(...all)] : [0, 1];
    const [x0, x1] = [x[0] ?? 0, x[x.length - 1] ?? 1];
    const x_at = (value: number) => left + ((value - x0) / (x1 - x0 || 1)) * (width - left - 20);
    const y_at = (value: number) => height - bottom - ((value - y0) / (y1 - y0 || 1)) * (height - bottom - top);
    const number = (value: number) => String(Number(value.toPrecision(4)));
    const parts = [0, 1, 2, 3, 4].flatMap((k) => {
        const [xk, yk] = [x0 + ((x1 - x0) * k) / 4, y0 + ((y1 - y0) * k) / 4];
        return [`<path d="M${left} ${y_at(yk).toFixed(1)}H${width - 20}" stroke="#ddd"/>`, `<text x="${left - 6}" y="${(y_at(yk) + 4).toFixed(1)}" text-anchor="end">${number(yk)}</text>`, `<text x="${x_at(xk).toFixed(1)}" y="${height - bottom + 18}" text-anchor="middle">${number(xk)}</text>`];
    });
    drawn.forEach((curve, at) => {
        const points = Array.from(curve.values, (value, row) => (Number.isFinite(value) ? `${x_at(x[row]).toFixed(1)},${y_at(value).toFixed(1)}` : "")).filter((point) => point !== "");
        parts.push(`<polyline points="${points.join(" ")}" fill="none" stroke="${curve.colour}" stroke-width="1.5"/>`, `<text x="${left + at * 150}" y="20" fill="${curve.colour}">${curve.name}</text>`);
    });
    parts.push(`<text x="${(width + left) / 2}" y="${height - 10}" text-anchor="middle">${x_name}</text>`, `<text x="16" y="${height / 2}" text-anchor="middle" transform="rotate(-90 16 ${height / 2})">${y_name}</text>`);
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="#fff"/>${parts.join("")}</svg>\n`;
}

interface Shown {
    settings: string[];
    frame: Frame | null;
}

export function listen_to_exports(shown: () => Shown): void {
    const on_click = (id: string, take: (frame: Frame) => void) =>
        element(id).addEventListener("click", () => {
            const { frame } = shown();
            if (frame !== null) take(frame);
        });
    element("export-toml").addEventListener("click", () => save("gyro.toml", "application/toml", toml(shown().settings)));
    on_click("export-csv", (frame) => save("signals.csv", "text/csv", csv(signal_names, frame.signals)));
    on_click("export-error-csv", (frame) => save("error.csv", "text/csv", csv(error_names, frame.error)));
    on_click("export-svg", (frame) => {
        const [time, ...errors] = frame.error;
        const curves = errors.map((values, at) => ({ name: error_curves[at][0], colour: error_curves[at][1], values }));
        save("error.svg", "image/svg+xml", svg("time, s", "error of the angle, arcsec", time, curves));
    });
}

// Elements of the page, by what names them, and new ones.

export function element<T extends HTMLElement = HTMLElement>(id: string): T {
    return document.getElementById(id) as T;
}

// Those that the page marks for readers by machine.
export function marked(name: string): HTMLElement {
    return document.querySelector<HTMLElement>(`[data-zlg="${name}"]`)!;
}

export function made<Name extends keyof HTMLElementTagNameMap>(name: Name, text = "", known: Record<string, string> = {}): HTMLElementTagNameMap[Name] {
    const element = document.createElement(name);
    element.textContent = text;
    for (const [key, value] of Object.entries(known)) element.setAttribute(key, value);
    return element;
}

// A new part of a drawing, in its parent.
export function part(parent: Element, name: string, attributes: Record<string, string | number>, text = ""): SVGElement {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name) as SVGElement;
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
    if (text) made.textContent = text;
    parent.append(made);
    return made;
}

// The lines of a field that are not empty.
export function lines_of(id: string): string[] {
    return element<HTMLTextAreaElement>(id).value.split("\n").map((line) => line.trim()).filter((line) => line !== "");
}

// A chart draws nothing for other numbers.
export function finite(value: number): number | null {
    return Number.isFinite(value) ? value : null;
}

// Nor has an axis of logarithms a place for others.
export function positive(value: number): number | null {
    return value > 0 && value < Infinity ? value : null;
}

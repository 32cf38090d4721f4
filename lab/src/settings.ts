// Settings of a gyro as text, `section.key=value` each, the value as TOML writes it.
import type { Key } from "./protocol";

// One number or text, or a list of them; empty where it is not given.
export function given(settings: string[], key: string): unknown[] {
    const setting = settings.find((each) => each.startsWith(`${key}=`));
    return setting === undefined ? [] : values(setting.slice(key.length + 1));
}

function values(toml: string): unknown[] {
    const value = parsed(toml);
    return Array.isArray(value) ? value : [value];
}

// In a link a text may stand without quotes.
function parsed(toml: string): unknown {
    try {
        return JSON.parse(toml);
    } catch {
        return toml;
    }
}

// Of one gyro: what was given, over the defaults of the table of keys.
export class Settings {
    constructor(
        private readonly keys: Key[],
        private readonly changed: string[],
    ) {}

    // Of a list its first.
    number(key: string): number {
        const found = given(this.changed, key);
        return Number((found.length > 0 ? found : values(this.keys.find((each) => `${each.section}.${each.name}` === key)!.default))[0]);
    }
}

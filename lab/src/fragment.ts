// The fragment of the page's address: `key=value` pairs joined by `&`, percent-encoded, the values as the program's --set reads them.

export interface Wanted {
    settings: string[]; // `section.key=value`
    until_s: string | null; // run to this time at full speed, then stop; a value of run.duration_s
}

const longest_bytes = 64 * 1024;

// What cannot be read is an Error whose message is for the reader of the page. Whether a key is known, the module decides.
export function parse_fragment(fragment: string): Wanted {
    const text = fragment.startsWith("#") ? fragment.slice(1) : fragment;
    const bytes = new TextEncoder().encode(text).length;
    if (bytes > longest_bytes) throw new Error(`the link: its configuration has ${bytes} bytes; allowed are ${longest_bytes}`);
    const wanted: Wanted = { settings: [], until_s: null };
    for (const pair of text.split("&")) {
        if (pair === "") continue;
        const setting = decoded(pair);
        // The module reads one setting a line.
        if (setting.includes("\n")) throw new Error(`the link: ${JSON.stringify(setting)} holds a line break; allowed is key=value in one line`);
        if (setting.startsWith("until=")) wanted.until_s = setting.slice("until=".length);
        else wanted.settings.push(setting);
    }
    return wanted;
}

function decoded(pair: string): string {
    try {
        return decodeURIComponent(pair);
    } catch {
        throw new Error(`the link: "${pair.slice(0, 80)}" is not percent-encoded text`);
    }
}

export function make_fragment(settings: Iterable<string>, until_s: string | null = null): string {
    const pairs = until_s === null ? [...settings] : [...settings, `until=${until_s}`];
    return pairs
        .map((setting) => {
            const at = setting.indexOf("=");
            return `${encodeURIComponent(setting.slice(0, at))}=${encodeURIComponent(setting.slice(at + 1))}`;
        })
        .join("&");
}

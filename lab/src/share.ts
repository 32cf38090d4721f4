// The dialogue with the link to this gyro.
import { element } from "./elements";
import { make_fragment } from "./fragment";

export interface Shared {
    settings: string[];
    time_s: number;
    turned: boolean; // by hand
}

// A word of a POSIX shell.
function quoted(word: string): string {
    return /^[\w.=,+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

export function share_dialog(shared: () => Shared): void {
    const dialog = element<HTMLDialogElement>("share-dialog");
    const link = element<HTMLTextAreaElement>("share-link");
    const until = element<HTMLInputElement>("share-until");
    const write = () => {
        const { settings, time_s, turned } = shared();
        element("share-note").textContent = turned ? "What was turned by hand is neither in the link nor in the command." : "";
        const fragment = make_fragment(settings, until.checked ? String(Number(time_s.toFixed(6))) : null);
        link.value = `${location.href.split("#")[0]}${fragment ? `#${fragment}` : ""}`;
        const duration = until.checked ? ["--duration", String(Number(time_s.toFixed(6)))] : [];
        element("share-command").textContent = ["zlg", "run", ...duration, ...settings.flatMap((each) => ["--set", quoted(each)])].join(" ");
    };
    until.addEventListener("change", write);
    element("share").addEventListener("click", () => {
        write();
        element("share-copied").textContent = "";
        dialog.showModal();
        link.select();
    });
    element("share-copy").addEventListener("click", () => {
        link.select();
        // From a file the clipboard may be closed to scripts; the text is then selected, to be copied by hand.
        const say = (text: string) => (element("share-copied").textContent = text);
        const by_hand = () => say("It is selected: copy it by the keyboard.");
        if (navigator.clipboard === undefined) by_hand();
        else navigator.clipboard.writeText(link.value).then(() => say("Copied."), by_hand);
    });
}

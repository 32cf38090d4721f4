// The dialogue with the link to this gyro.
import { element } from "./elements";
import { make_fragment } from "./fragment";

export interface Shared {
    settings: string[];
    time_s: number;
    turned: boolean; // by hand
    has_own_second: boolean;
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
        const { settings, time_s, turned, has_own_second } = shared();
        const is_recorded = settings.some((setting) => /^motion\.kind="?file"?$/.test(setting));
        // Whoever opens the link has no file.
        const linked = is_recorded ? settings.filter((setting) => !setting.startsWith("motion.")) : settings;
        const notes = [
            is_recorded ? "The recorded motion is not in the link, which has the motion of the default gyro; the command needs its file, which “Recorded motions” saves." : "",
            turned ? "What was turned by hand is neither in the link nor in the command." : "",
            has_own_second ? "The settings of the second gyro are in neither." : "",
        ];
        element("share-note").textContent = notes.filter((note) => note !== "").join(" ");
        const fragment = make_fragment(linked, until.checked ? String(Number(time_s.toFixed(6))) : null);
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

// The card of recorded motions: those that the page makes, and files of the reader's own.
import type { GyroClient } from "./client";
import { element, made } from "./elements";
import { save } from "./export";
import { choose_file } from "./files";
import { made_motion, made_motion_names } from "./made_motions";

export class Motions {
    private file: File | null = null;

    constructor(private readonly client: () => GyroClient) {
        for (const name of made_motion_names) {
            const button = made("button", name.replaceAll("_", " "), { type: "button" });
            button.addEventListener("click", () => this.read(made_motion(name)));
            element("motions").append(button);
        }
        choose_file(element("open-motion"), element<HTMLInputElement>("motion-file"), (file) => this.read(file));
        element("motion-save").addEventListener("click", () => this.file !== null && save(this.file.name, "text/csv", this.file));
    }

    read(file: File): void {
        this.file = file;
        this.say(`Reading ${file.name} …`, false);
        this.client().send({ kind: "read_motion", file });
    }

    // After a file was read, or refused.
    say(text: string, is_refusal: boolean): void {
        element("motion-text").textContent = text;
        element("motion-text").classList.toggle("wrong", is_refusal);
        element("motion-save").hidden = is_refusal || this.file === null;
    }
}

// The settings with another motion.
export function with_motion(settings: string[], motion: string[]): string[] {
    return [...settings.filter((setting) => !setting.startsWith("motion.")), ...motion];
}

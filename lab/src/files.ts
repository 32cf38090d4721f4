// Files that the reader gives to the page, dropped anywhere on it or chosen.

export function choose_file(button: HTMLElement, input: HTMLInputElement, take: (file: File) => void): void {
    button.addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
        if (input.files?.[0]) take(input.files[0]);
        input.value = ""; // the same file may be chosen again
    });
}

export function on_drop(take: (file: File) => void): void {
    const holds_files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    document.addEventListener("dragover", (event) => {
        if (!holds_files(event)) return;
        event.preventDefault();
        document.body.classList.add("dropping");
    });
    document.addEventListener("dragleave", (event) => {
        if (event.relatedTarget === null) document.body.classList.remove("dropping");
    });
    document.addEventListener("drop", (event) => {
        document.body.classList.remove("dropping");
        if (!holds_files(event)) return;
        event.preventDefault();
        const file = event.dataTransfer!.files[0];
        if (file) take(file);
    });
}

// Frames on their way from the worker to the screen: the newest is drawn, and the page is left free for its reader as long as a drawing
// has taken, however slow it is.
import type { Frame } from "./protocol";

const hidden_ms = 200; // between two looks at a page that does not show

export class Frames {
    private waiting: Frame | null = null;

    // draw     one frame.
    // on_seen  the worker may send the next.
    constructor(
        private readonly draw: (frame: Frame) => void,
        private readonly on_seen: () => void,
    ) {}

    // What is told once only is kept of a frame that is not drawn.
    take(frame: Frame): void {
        const { switches, picture } = this.waiting ?? { switches: [], picture: null };
        const is_first = this.waiting === null;
        this.waiting = { ...frame, switches: [...switches, ...frame.switches], picture: frame.picture ?? picture };
        if (!is_first) return;
        // A hidden page draws nothing of itself.
        if (document.hidden) setTimeout(() => this.show(), hidden_ms);
        else requestAnimationFrame(() => this.show());
    }

    // Those that wait are of a gyro that is no more.
    forget(): void {
        this.waiting = null;
    }

    private show(): void {
        const frame = this.waiting;
        this.waiting = null;
        const begin_ms = performance.now();
        if (frame !== null) this.draw(frame);
        // Behind what the browser paints.
        setTimeout(() => setTimeout(this.on_seen, performance.now() - begin_ms));
    }
}

// The gyro as the page sees it: the worker behind one interface.
import type { FromWorker, Gyro, ToWorker } from "./protocol";

// Hears each kind of message.
export type Listener = { [Kind in FromWorker["kind"]]: (message: Extract<FromWorker, { kind: Kind }>) => void };

export class GyroClient {
    private readonly worker: Worker;
    private asked = 0; // number of the gyro that was asked for last
    private answered = 0; // of the one that was taken or refused last
    private number = 0; // of the one that the worker has

    // worker_script, code  texts of the page: the worker's script, and the module, gzipped, in base64.
    // listener  of a gyro, or of a log; it hears of what it listens to.
    constructor(worker_script: string, code: string, listener: Partial<Listener>) {
        const address = URL.createObjectURL(new Blob([worker_script], { type: "text/javascript" }));
        this.worker = new Worker(address);
        URL.revokeObjectURL(address);
        this.worker.onmessage = (event: MessageEvent<FromWorker>) => this.take(event.data, listener);
        this.worker.onerror = (event) => listener.refused?.({ kind: "refused", number: 0, message: `the page's worker has failed: ${event.message}`, whole: true });
        this.send({ kind: "load", code });
    }

    send(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    // Whether the gyro that was asked for last is neither taken nor refused yet.
    waits(): boolean {
        return this.answered !== this.asked;
    }

    configure(gyro: Gyro, running: boolean): void {
        this.send({ kind: "configure", number: ++this.asked, gyro, running });
    }

    // Nothing more comes from it.
    end(): void {
        this.worker.terminate();
    }

    private take(message: FromWorker, listener: Partial<Listener>): void {
        if (message.kind === "configured") this.number = this.answered = message.number;
        if (message.kind === "refused") this.answered = message.number;
        // Of one that another follows already nothing is said.
        if (message.kind === "refused" && this.waits()) return;
        if (message.kind === "frame" && message.number !== this.number) this.send({ kind: "seen" });
        else (listener[message.kind] as ((message: FromWorker) => void) | undefined)?.(message);
    }
}

// The gyro as the page sees it: the worker behind one interface.
import type { Design, Frame, FromWorker, Gyro, LogPicture, Schema, ToWorker } from "./protocol";

export interface Listener {
    loaded(schema: Schema): void;
    configured(changed: string[], is_newest: boolean): void; // is_newest: nothing else was asked for meanwhile
    refused(message: string, whole: boolean): void;
    frame(frame: Frame): void;
    designed(design: Design): void;
    motion_read(name: string, settings: string[], note: string): void;
    motion_refused(message: string): void;
    log_progress(fraction: number, ticks: number): void;
    log_read(log: LogPicture): void;
    log_angles(name: string, text: Blob): void;
}

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
        this.worker.onerror = (event) => listener.refused?.(`the page's worker has failed: ${event.message}`, true);
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
        switch (message.kind) {
            case "loaded":
                return listener.loaded?.(message.schema);
            case "configured":
                this.number = this.answered = message.number;
                return listener.configured?.(message.changed, !this.waits());
            case "refused":
                this.answered = message.number;
                // Of one that another follows already nothing is said.
                return this.waits() ? undefined : listener.refused?.(message.message, message.whole);
            case "designed":
                return listener.designed?.(message.design);
            case "motion_read":
                return listener.motion_read?.(message.name, message.settings, message.note);
            case "motion_refused":
                return listener.motion_refused?.(message.message);
            case "log_progress":
                return listener.log_progress?.(message.fraction, message.ticks);
            case "log_read":
                return listener.log_read?.(message.log);
            case "log_angles":
                return listener.log_angles?.(message.name, message.text);
            case "frame":
                if (message.number === this.number) listener.frame?.(message);
                else this.send({ kind: "seen" });
        }
    }
}

// What the C library of the module asks of a system (WASI, snapshot preview 1): there are neither arguments nor an environment, nothing
// is printed, and there is at most one file, which is read.

const success = 0;
const bad_number = 8;
const no_such_call = 52;
const regular_file = 4;
const page_file = 3; // its number, as lab/module/page_file.cpp has it

// A worker has it; the library of types for pages does not name it.
declare class FileReaderSync {
    readAsArrayBuffer(blob: Blob): ArrayBuffer;
}

// A file of the reader's, in a worker, where it can be read at once.
export class PageFile {
    private at = 0;
    private readonly reader = new FileReaderSync();

    constructor(readonly file: File) {}

    seek(to: number): void {
        this.at = to;
    }

    next(bytes: number): Uint8Array {
        const found = this.bytes(this.at, bytes);
        this.at += found.length;
        return found;
    }

    bytes(from: number, count: number): Uint8Array {
        return new Uint8Array(this.reader.readAsArrayBuffer(this.file.slice(from, from + count)));
    }
}

type Call = (...words: (number | bigint)[]) => number;

export class System {
    memory: WebAssembly.Memory | null = null;
    file: PageFile | null = null;

    // For every call that the module names.
    imports(module: WebAssembly.Module): WebAssembly.Imports {
        const known = this.calls();
        const system: Record<string, Call> = {};
        for (const wanted of WebAssembly.Module.imports(module)) system[wanted.name] = known[wanted.name] ?? (() => no_such_call);
        return { wasi_snapshot_preview1: system };
    }

    private calls(): Record<string, Call> {
        return {
            environ_sizes_get: (count, bytes) => {
                this.view().setUint32(Number(count), 0, true);
                this.view().setUint32(Number(bytes), 0, true);
                return success;
            },
            environ_get: () => success,
            proc_exit: (status) => {
                throw new Error(`the module has ended with status ${status}`);
            },
            fd_seek: (fd, offset, _from, result) => {
                if (fd !== page_file || this.file === null) return bad_number;
                this.file.seek(Number(offset));
                this.view().setBigUint64(Number(result), BigInt(offset), true);
                return success;
            },
            fd_read: (fd, places, count, read) => this.read(fd, places, count, read, (bytes) => this.file!.next(bytes)),
            fd_pread: (fd, places, count, offset, read) => this.read(fd, places, count, read, (bytes) => this.file!.bytes(Number(offset), bytes)),
            fd_filestat_get: (fd, place) => {
                if (fd !== page_file || this.file === null) return bad_number;
                new Uint8Array(this.memory!.buffer, Number(place), 64).fill(0);
                this.view().setUint8(Number(place) + 16, regular_file);
                this.view().setBigUint64(Number(place) + 32, BigInt(this.file.file.size), true);
                return success;
            },
            fd_close: () => success,
        };
    }

    // Into the first of the places {address, bytes} that has room: a reader asks for the rest.
    private read(fd: number | bigint, places: number | bigint, count: number | bigint, read: number | bigint, take: (bytes: number) => Uint8Array): number {
        if (fd !== page_file || this.file === null) return bad_number;
        let found = 0;
        for (let k = 0; k < Number(count) && found === 0; ++k) {
            const place = Number(places) + 8 * k;
            const bytes = take(this.view().getUint32(place + 4, true));
            new Uint8Array(this.memory!.buffer).set(bytes, this.view().getUint32(place, true));
            found = bytes.length;
        }
        this.view().setUint32(Number(read), found, true);
        return success;
    }

    private view(): DataView {
        return new DataView(this.memory!.buffer);
    }
}

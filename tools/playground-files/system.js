// What the program asks of a system, files, time and random numbers (WASI, preview 1), all in memory. What it does not ask for is not here.

const DONE = 0;
const BAD_HANDLE = 8;
const EXISTS = 20;
const INVALID = 28;
const IS_FOLDER = 31;
const NOT_THERE = 44;
const NO_FOLDER = 54;
const NOT_EMPTY = 55;
const UNKNOWN = 58;

const FOLDER = 3;
const FILE = 4;
const TERMINAL = 2;
const ALL_RIGHTS = 2n ** 64n - 1n;
// The handle of the root folder, after those of standard input, output and errors.
const ROOT = 3;

class Folder {
  constructor() {
    this.kind = FOLDER;
    this.entries = new Map();
    this.time = now();
  }

  get length() {
    return 0;
  }
}

class File {
  constructor(bytes = new Uint8Array(0)) {
    this.kind = FILE;
    this.store = bytes;
    this.length = bytes.length;
    this.time = now();
  }

  get bytes() {
    return this.store.subarray(0, this.length);
  }

  resize(length) {
    if (length > this.store.length) {
      // Half as much again, so that a table that grows by rows is not copied for each.
      const store = new Uint8Array(Math.max(length, this.store.length + (this.store.length >> 1)));
      store.set(this.bytes);
      this.store = store;
    }
    if (length > this.length) this.store.fill(0, this.length, length);
    this.length = length;
  }

  write(at, bytes) {
    if (at + bytes.length > this.length) this.resize(at + bytes.length);
    this.store.set(bytes, at);
    this.time = now();
  }
}

// Nanoseconds since 1970.
function now() {
  return BigInt(Date.now()) * 1000000n;
}

// A tree of files.
class Files {
  constructor() {
    this.root = new Folder();
  }

  // The folder of a path, and the name in it; the last name may not exist.
  place(path) {
    const names = [];
    for (const name of path.split("/")) {
      if (name === "..") names.pop();
      else if (name !== "" && name !== ".") names.push(name);
    }
    const last = names.pop();
    let folder = this.root;
    for (const name of names) {
      folder = folder?.entries?.get(name);
    }
    return { folder: folder?.kind === FOLDER ? folder : undefined, name: last };
  }

  find(path) {
    const { folder, name } = this.place(path);
    return name === undefined ? this.root : folder?.entries.get(name);
  }

  // Puts a file in its place, and makes the folders on the way.
  put(path, bytes) {
    const names = path.split("/").filter(Boolean);
    const last = names.pop();
    let folder = this.root;
    for (const name of names) {
      if (!folder.entries.has(name)) folder.entries.set(name, new Folder());
      folder = folder.entries.get(name);
    }
    folder.entries.set(last, new File(bytes));
  }

  text(path) {
    const file = this.find(path);
    return file?.kind === FILE ? new TextDecoder().decode(file.bytes.slice()) : null;
  }

  // Names and bytes of the files in a folder that are not hidden.
  in(path) {
    const entries = this.find(path)?.entries ?? new Map();
    return [...entries].filter(([name, it]) => it.kind === FILE && !name.startsWith(".")).map(([name, it]) => ({ name, bytes: it.bytes.slice() }));
  }
}

class Exit extends Error {
  constructor(code) {
    super(`the program ended with ${code}`);
    this.code = code;
  }
}

// One run of the program with its words, such as ["ligament", "run", "case.toml"].
class Process {
  // `on.said` is called with what it says, `on.wrote` with the path and text of what was appended to a table.
  constructor(words, files, on = {}) {
    Object.assign(this, { words, files, on });
    this.handles = [null, null, null, { path: "/", node: files.root, at: 0 }];
    this.said = "";
    this.decoders = [new TextDecoder(), new TextDecoder(), new TextDecoder()];
  }

  // Runs it to its end; its exit code.
  run(module) {
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      imports[from] ??= {};
      imports[from][name] = this[name]?.bind(this) ?? (() => UNKNOWN);
    }
    const instance = new WebAssembly.Instance(module, imports);
    this.memory = instance.exports.memory;
    try {
      instance.exports._start();
    } catch (error) {
      if (error instanceof Exit) return error.code;
      this.say(`\nerror: the program stopped: ${error.message}\n`);
      return 70;
    }
    return 0;
  }

  say(text) {
    this.said += text;
    this.on.said?.(text);
  }

  // Views are made anew each time, since the memory may have grown.
  get view() {
    return new DataView(this.memory.buffer);
  }

  bytes(at, length) {
    return new Uint8Array(this.memory.buffer, at, length);
  }

  text(at, length) {
    return new TextDecoder().decode(this.bytes(at, length).slice());
  }

  // Path of a name below an open folder.
  path(handle, at, length) {
    const base = this.handles[handle]?.path ?? "/";
    return `${base}/${this.text(at, length)}`.replace(/\/+/g, "/");
  }

  file(handle) {
    const open = this.handles[handle];
    return open?.node.kind === FILE ? open : null;
  }

  // Texts one after the other, each closed by a zero, and their places.
  putTexts(texts, places, at) {
    for (const text of texts) {
      const bytes = new TextEncoder().encode(`${text}\0`);
      this.view.setUint32(places, at, true);
      this.bytes(at, bytes.length).set(bytes);
      places += 4;
      at += bytes.length;
    }
    return DONE;
  }

  putSizes(texts, count, size) {
    this.view.setUint32(count, texts.length, true);
    this.view.setUint32(size, texts.reduce((sum, it) => sum + new TextEncoder().encode(it).length + 1, 0), true);
    return DONE;
  }

  args_sizes_get(count, size) { return this.putSizes(this.words, count, size); }
  args_get(places, at) { return this.putTexts(this.words, places, at); }
  environ_sizes_get(count, size) { return this.putSizes([], count, size); }
  environ_get() { return DONE; }

  clock_time_get(clock, _, at) {
    const isMonotonic = clock === 1;
    this.view.setBigUint64(at, isMonotonic ? BigInt(Math.round(performance.now() * 1e6)) : now(), true);
    return DONE;
  }

  random_get(at, length) {
    for (let from = 0; from < length; from += 65536) crypto.getRandomValues(this.bytes(at + from, Math.min(65536, length - from)));
    return DONE;
  }

  proc_exit(code) { throw new Exit(code); }
  sched_yield() { return DONE; }

  fd_prestat_get(handle, at) {
    if (handle !== ROOT) return BAD_HANDLE;
    this.view.setUint32(at, 0, true);
    this.view.setUint32(at + 4, 1, true);
    return DONE;
  }

  fd_prestat_dir_name(handle, at) {
    if (handle !== ROOT) return BAD_HANDLE;
    this.bytes(at, 1)[0] = 47;
    return DONE;
  }

  fd_fdstat_get(handle, at) {
    const kind = handle < ROOT ? TERMINAL : this.handles[handle]?.node.kind;
    if (kind === undefined) return BAD_HANDLE;
    const { view } = this;
    view.setUint8(at, kind);
    view.setUint16(at + 2, this.handles[handle]?.appends ? 1 : 0, true);
    view.setBigUint64(at + 8, ALL_RIGHTS, true);
    view.setBigUint64(at + 16, ALL_RIGHTS, true);
    return DONE;
  }

  fd_close(handle) {
    if (!this.handles[handle]) return BAD_HANDLE;
    this.handles[handle] = undefined;
    return DONE;
  }

  fd_sync() { return DONE; }

  // There are no links.
  path_readlink() { return INVALID; }

  putStatus(node, at) {
    const { view } = this;
    this.bytes(at, 64).fill(0);
    // Two files are the same if their numbers are.
    node.number ??= BigInt(Math.floor(Math.random() * Number.MAX_SAFE_INTEGER));
    view.setBigUint64(at + 8, node.number, true);
    view.setUint8(at + 16, node.kind);
    view.setBigUint64(at + 24, 1n, true);
    view.setBigUint64(at + 32, BigInt(node.length), true);
    for (const place of [40, 48, 56]) view.setBigUint64(at + place, node.time, true);
    return DONE;
  }

  fd_filestat_get(handle, at) {
    if (handle < ROOT) return this.putStatus({ kind: TERMINAL, length: 0, time: 0n }, at);
    const open = this.handles[handle];
    return open ? this.putStatus(open.node, at) : BAD_HANDLE;
  }

  path_filestat_get(handle, _, at, length, status) {
    const node = this.files.find(this.path(handle, at, length));
    return node ? this.putStatus(node, status) : NOT_THERE;
  }

  fd_filestat_set_size(handle, length) {
    const open = this.file(handle);
    if (!open) return BAD_HANDLE;
    open.node.resize(Number(length));
    return DONE;
  }

  path_open(handle, _, at, length, how, rights, inherited, flags, result) {
    const path = this.path(handle, at, length);
    const { folder, name } = this.files.place(path);
    let node = this.files.find(path);
    const [creates, isFolder, isNew, empties] = [1, 2, 4, 8].map((it) => (how & it) !== 0);
    if (node && creates && isNew) return EXISTS;
    if (!node) {
      if (!creates || !folder) return NOT_THERE;
      node = new File();
      folder.entries.set(name, node);
    }
    if (isFolder && node.kind !== FOLDER) return NO_FOLDER;
    if (empties && node.kind === FOLDER) return IS_FOLDER;
    if (empties) node.resize(0);
    this.handles.push({ path, node, at: 0, appends: (flags & 1) === 1 });
    this.view.setUint32(result, this.handles.length - 1, true);
    return DONE;
  }

  // Parts of the memory, from a list of their places and lengths.
  parts(list, count) {
    const { view } = this;
    return Array.from({ length: count }, (_, place) => this.bytes(view.getUint32(list + 8 * place, true), view.getUint32(list + 8 * place + 4, true)));
  }

  fd_read(handle, list, count, result) {
    const open = this.file(handle);
    if (!open && handle >= ROOT) return BAD_HANDLE;
    const read = open ? this.readAt(open.node, open.at, list, count) : 0;
    if (open) open.at += read;
    this.view.setUint32(result, read, true);
    return DONE;
  }

  readAt(file, from, list, count) {
    let at = from;
    for (const part of this.parts(list, count)) {
      const bytes = file.bytes.subarray(at, at + part.length);
      part.set(bytes);
      at += bytes.length;
    }
    return Math.max(at - from, 0);
  }

  fd_write(handle, list, count, result) {
    const open = this.file(handle);
    if (!open && handle >= ROOT) return BAD_HANDLE;
    let written = 0;
    for (const part of this.parts(list, count)) {
      written += part.length;
      if (!open) {
        this.say(this.decoders[handle].decode(part.slice(), { stream: true }));
        continue;
      }
      if (open.appends) open.at = open.node.length;
      open.node.write(open.at, part);
      open.at += part.length;
      if (open.path.endsWith(".csv")) this.on.wrote?.(open.path, part);
    }
    this.view.setUint32(result, written, true);
    return DONE;
  }

  fd_seek(handle, offset, from, result) {
    const open = this.file(handle);
    if (!open) return BAD_HANDLE;
    const at = [0, open.at, open.node.length][from] + Number(offset);
    if (!(at >= 0)) return INVALID;
    open.at = at;
    this.view.setBigUint64(result, BigInt(at), true);
    return DONE;
  }

  fd_readdir(handle, at, length, from, result) {
    const open = this.handles[handle];
    if (open?.node.kind !== FOLDER) return NO_FOLDER;
    // Of one moment: a reader may remove what it has read.
    if (from === 0n || !open.listed) open.listed = [...open.node.entries];
    const entries = open.listed;
    let used = 0;
    for (let place = Number(from); place < entries.length && used < length; place++) {
      const [name, node] = entries[place];
      const text = new TextEncoder().encode(name);
      const entry = new Uint8Array(24 + text.length);
      const view = new DataView(entry.buffer);
      view.setBigUint64(0, BigInt(place + 1), true);
      view.setUint32(16, text.length, true);
      view.setUint8(20, node.kind);
      entry.set(text, 24);
      // An entry that does not fit is cut off, and asked for again.
      const part = entry.subarray(0, length - used);
      this.bytes(at + used, part.length).set(part);
      used += part.length;
    }
    this.view.setUint32(result, used, true);
    return DONE;
  }

  path_create_directory(handle, at, length) {
    const { folder, name } = this.files.place(this.path(handle, at, length));
    if (!folder) return NOT_THERE;
    if (folder.entries.has(name)) return EXISTS;
    folder.entries.set(name, new Folder());
    return DONE;
  }

  path_remove_directory(handle, at, length) {
    return this.remove(this.path(handle, at, length), (node) => (node.kind !== FOLDER ? NO_FOLDER : node.entries.size ? NOT_EMPTY : DONE));
  }

  path_unlink_file(handle, at, length) {
    return this.remove(this.path(handle, at, length), (node) => (node.kind === FOLDER ? IS_FOLDER : DONE));
  }

  remove(path, mayBe) {
    const { folder, name } = this.files.place(path);
    const node = folder?.entries.get(name);
    if (!node) return NOT_THERE;
    const answer = mayBe(node);
    if (answer === DONE) folder.entries.delete(name);
    return answer;
  }

  path_rename(handle, at, length, newHandle, newAt, newLength) {
    const [from, to] = [this.path(handle, at, length), this.path(newHandle, newAt, newLength)];
    const [before, after] = [this.files.place(from), this.files.place(to)];
    const node = before.folder?.entries.get(before.name);
    if (!node || !after.folder) return NOT_THERE;
    const there = after.folder.entries.get(after.name);
    if (there?.kind === FOLDER && there.entries.size) return NOT_EMPTY;
    before.folder.entries.delete(before.name);
    after.folder.entries.set(after.name, node);
    // Open files of a moved folder have other paths now.
    for (const open of this.handles) {
      if (open && (open.path === from || open.path.startsWith(`${from}/`))) open.path = to + open.path.slice(from.length);
    }
    return DONE;
  }
}

// The program as this page has it: compiled once, run in workers.

// The bytes of a script of the page.
function bytesOf(id) {
  const binary = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(binary.length);
  for (let place = 0; place < bytes.length; place++) bytes[place] = binary.charCodeAt(place);
  return bytes;
}

async function unzipped(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

class Program {
  constructor() {
    const source = document.getElementById("worker").textContent;
    this.worker = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  }

  // Once the whole page has been read.
  compile() {
    this.module = this.ask({ packed: bytesOf("program") }).ended;
    return this.module;
  }

  // Begins a task: `path` of a case to run, or `words` of a command and the path of a file that it `asks` back. `tells` is called with what
  // comes before the end. The promise of its end, which is null once it was stopped, and the function that stops it.
  begin(task, tells = () => {}) {
    return this.ask(this.module.then((module) => ({ ...task, module })), tells);
  }

  ask(task, tells) {
    const worker = new Worker(this.worker);
    let stop;
    const ended = new Promise((resolve, reject) => {
      stop = () => {
        worker.terminate();
        resolve(null);
      };
      worker.onmessage = ({ data }) => {
        if (!data.ended) return tells(data);
        worker.terminate();
        resolve(data.ended);
      };
      worker.onerror = (event) => {
        worker.terminate();
        reject(new Error(event.message));
      };
      Promise.resolve(task).then((it) => worker.postMessage(it)).catch(reject);
    });
    return { ended, stop };
  }
}

// The description of a page of `ligament report` with its columns in it, and its summary.
function readPage(html) {
  const page = new DOMParser().parseFromString(html, "text/html");
  const texts = [...page.querySelectorAll("script[type='text/plain']")].map((it) => it.textContent);
  const description = JSON.parse(page.getElementById("description").textContent, (key, value) => (
    key === "texts" ? texts.slice(...value) : value
  ));
  return { description, summary: page.querySelector(".summary") };
}

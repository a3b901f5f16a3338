// The program in a worker of its own: it ends with the worker, and its memory goes with it.

const RESULTS = "/results";
// Texts are passed on, ms after those before; a look at results under way takes at most this share of the time.
const PASSED_ON = 80;
const LOOKS = 0.2;

// A page of the results that are there, as `ligament report` writes it; null where there is none yet.
function pageOf(module, files, ...options) {
  const process = new Process(["ligament", "report", RESULTS, "--out", "/page.html", "--force", ...options], files);
  return process.run(module) === 0 ? files.text("/page.html") : null;
}

// Runs the case. Broken bonds are told as they break; the results so far are looked at after a step, by a second instance of the program
// over the same files.
function solve(module, files, path) {
  let broken = "";
  let told = performance.now();
  let next = told;
  const decoder = new TextDecoder();
  const tell = () => {
    if (broken) postMessage({ broken });
    broken = "";
    told = performance.now();
  };
  const look = () => {
    const begun = performance.now();
    const page = pageOf(module, files, "--steps", "2", "--digits", "3");
    if (page) {
      tell();
      postMessage({ page });
    }
    next = performance.now() + (performance.now() - begun) / LOOKS;
  };
  const process = new Process(["ligament", "run", path, "--out", RESULTS, "--force"], files, {
    said: (said) => postMessage({ said }),
    wrote: (name, bytes) => {
      if (name.endsWith("/breaks.csv")) broken += decoder.decode(bytes.slice(), { stream: true });
      if (performance.now() - told > PASSED_ON) tell();
      if (name.endsWith("/history.csv") && performance.now() > next) look();
    },
  });
  const code = process.run(module);
  tell();
  const page = files.find(`${RESULTS}/model.vtu`) ? pageOf(module, files) : null;
  return { code, said: process.said, page, results: files.in(RESULTS) };
}

onmessage = async ({ data }) => {
  if (data.packed) {
    postMessage({ ended: await WebAssembly.compile(unpacked(data.packed)) });
    return;
  }
  const files = new Files();
  for (const { path, bytes } of data.files) files.put(path, bytes);
  const began = performance.now();
  let answer;
  if (data.words) {
    const process = new Process(["ligament", ...data.words], files);
    answer = { code: process.run(data.module), said: process.said, written: data.asks ? files.text(data.asks) : null };
  } else {
    answer = solve(data.module, files, data.path);
  }
  const seconds = (performance.now() - began) / 1000;
  postMessage({ ended: { ...answer, seconds } }, (answer.results ?? []).map(({ bytes }) => bytes.buffer));
};

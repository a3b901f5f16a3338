// The page of results while they come: the viewer of `ligament report`, which goes on with the results of a run as they grow.

// Time between two pictures of the bonds that break, ms.
const PICTURES = 80;

class LivePage extends Page {
  constructor(description) {
    super(description);
    this.begin();
  }

  // The results of a run from its beginning.
  begin() {
    this.isPlaying = false;
    Object.assign(this, { isNew: true, isLive: true, broken: null, placeOfTag: null, bondsSoFar: [], ends: null, rest: "" });
  }

  // Rows of broken bonds as they are written; the first row names the columns.
  break(text) {
    const lines = (this.rest + text).split("\n");
    this.rest = lines.pop();
    for (const line of lines) {
      const row = line.split(",");
      if (!this.ends) this.ends = ["_a", "_b"].map((end) => row.findIndex((it) => it.endsWith(end)));
      else this.bondsSoFar.push(this.ends.map((column) => Number(row[column])));
    }
    this.drawBonds();
  }

  // One picture a while: the program and the graphics may share a processor.
  drawBonds() {
    if (this.isDue || !this.isLive) return;
    this.isDue = true;
    setTimeout(() => requestAnimationFrame(() => {
      this.isDue = false;
      if (!this.isLive || !this.placeOfTag) return;
      this.broken = this.pairsSoFar();
      this.redraw();
    }), PICTURES);
  }

  pairsSoFar() {
    if (!this.placeOfTag) return [];
    return this.bondsSoFar.map((tags) => tags.map((it) => this.placeOfTag.get(it))).filter((pair) => pair.every((it) => it !== undefined));
  }

  // Results that are further on; at the `end` of the run they are whole.
  async take(description, end) {
    this.isLive = !end;
    const runs = description.runs.map((it) => new Run(it));
    const [run] = runs;
    const isSameBody = !this.isNew && this.body && run.nPoints === this.body.x.length;
    Object.assign(this, { runs, step: run.steps.length - 1, keeps: isSameBody ? { field: element("field").value, cracks: element("cracks").value } : null });
    // The field that shows best what happened is another one once bonds break.
    if (this.keeps && this.keeps.field === this.offered) this.keeps.field = run.description.firstField;
    this.offered = run.description.firstField;
    this.isNew = false;
    this.charts.runs = runs;
    this.charts.marked = null;
    this.charts.offer();
    this.charts.showCurve();
    this.run = run;
    await this.showRun(run);
    element("step").closest(".steps").hidden = this.isLive || run.steps.length < 2;
  }

  // The camera stays where it was, if the body is still the same.
  async showBody(run, isOther) {
    const { keeps } = this;
    const { scene } = this;
    const seen = { ...scene.camera };
    await super.showBody(run, isOther);
    this.placeOfTag = new Map(Array.from(this.body.tags, (tag, place) => [tag, place]));
    if (keeps) {
      Object.assign(scene.camera, seen);
      element("field").value = run.choice(keeps.field).id;
    }
    const offered = [...element("cracks").options].map((it) => it.value);
    const wanted = this.isLive ? ["bonds"] : ["open", "lines", "bonds"];
    element("cracks").value = wanted.find((it) => offered.includes(it)) ?? offered[0];
  }

  async readBroken() {
    return this.isLive ? this.pairsSoFar() : super.readBroken();
  }
}

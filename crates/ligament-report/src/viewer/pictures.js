// Pictures of a solid, which the program has drawn: of each view, field and step one.

class Pictures {
  // `changed` is called when another picture is asked for.
  constructor(changed) {
    this.image = document.getElementById("picture");
    this.view = document.getElementById("view");
    this.field = document.getElementById("solid-field");
    this.asked = 0;
    this.view.addEventListener("change", () => {
      this.offerFields(this.field.value);
      changed();
    });
    this.field.addEventListener("change", changed);
  }

  // The views of a result, and the fields of the first of them; those that were chosen before, where it has them.
  offer(run) {
    const [view, field] = [this.view.value, this.field.value];
    this.series = run.pictures.series;
    const views = run.pictures.views.filter((it) => this.series.some(({ view: id }) => id === it.id));
    options(this.view, views.map((it) => [it.id, it.label]));
    if (views.some((it) => it.id === view)) this.view.value = view;
    this.offerFields(field || run.firstChoice);
  }

  offerFields(chosen) {
    const fields = this.series.filter((it) => it.view === this.view.value).map((it) => it.field);
    options(this.field, fields.map((it) => [it, inWords(it)]));
    if (fields.includes(chosen)) this.field.value = chosen;
  }

  // Shows the picture of a step; of several asked for in a row the last.
  async show(step) {
    const asked = ++this.asked;
    const shown = this.series.find((it) => it.view === this.view.value && it.field === this.field.value);
    if (!shown) return false;
    const bytes = await bytesOfText(shown.texts[step]);
    if (asked !== this.asked) return false;
    const before = this.image.src;
    this.image.src = URL.createObjectURL(new Blob([bytes], { type: "image/svg+xml" }));
    this.image.alt = `${inWords(shown.field)}, ${this.view.selectedOptions[0].textContent}`;
    await this.image.decode();
    if (before) URL.revokeObjectURL(before);
    return asked === this.asked;
  }
}

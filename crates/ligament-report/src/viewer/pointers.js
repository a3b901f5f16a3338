// Pointers on the body: hover, click, drag and wheel, and two fingers. A drag turns a solid, and moves a body in the plane.

function listenToPointers(pane, page) {
  const { canvas } = pane;
  const pointers = new Map();
  let moved = 0;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const both = (of) => {
    const [one, other] = [...pointers.values()];
    return of(one, other);
  };
  const spread = () => both((one, other) => Math.hypot(one[0] - other[0], one[1] - other[1]));
  const middle = () => both((one, other) => [0, 1].map((axis) => (one[axis] + other[axis]) / 2));
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, place(event));
    canvas.setPointerCapture(event.pointerId);
    moved = 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      page.hover(pane, ...now);
      return;
    }
    const [distance, centre] = pointers.size === 2 ? [spread(), middle()] : [0, now];
    pointers.set(event.pointerId, now);
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    moved += Math.hypot(dx, dy);
    if (pointers.size === 2) {
      const [mx, my] = middle();
      page.zoom(spread() / Math.max(distance, 1), mx, my);
      page.move(mx - centre[0], my - centre[1]);
    } else if (moved > 4) {
      const moves = event.shiftKey || (event.buttons & 6) !== 0;
      page.drag(dx, dy, moves);
    }
  });
  canvas.addEventListener("pointerup", (event) => {
    const isClick = pointers.size === 1 && moved <= 4;
    pointers.delete(event.pointerId);
    if (!isClick) return;
    const point = pane.scene.pointAt(...place(event));
    const isPinned = page.pinned?.pane === pane && page.pinned.point === point;
    page.pin(pane, isPinned ? null : point);
  });
  canvas.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    page.zoom(1.0015 ** -event.deltaY, ...place(event));
  }, { passive: false });
}

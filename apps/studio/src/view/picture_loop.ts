// Draws a picture once a frame, as large as the box that its canvas is in.

interface Drawn {
  resize(width: number, height: number, pixelRatio: number): void;
  dispose(): void;
}

/** Runs until it is told to stop, and then disposes of the picture. `draw` gets the seconds since the last time and says whether the picture wants to be fitted anew, for it draws fewer or more pixels from now on. */
export function runPicture(canvas: HTMLCanvasElement, picture: Drawn, draw: (seconds: number) => boolean): () => void {
  const box = canvas.parentElement!;
  const fit = () => picture.resize(box.clientWidth, box.clientHeight, devicePixelRatio);
  const watch = new ResizeObserver(fit);
  watch.observe(box);
  let last = performance.now(), asked = 0, tired = false;
  const next = (now: number) => {
    const seconds = Math.max((now - last) / 1000, 0);
    last = now;
    if (tired) fit(); // which empties the canvas: right before it is drawn
    tired = draw(seconds);
    asked = requestAnimationFrame(next);
  };
  asked = requestAnimationFrame(next);
  return () => {
    cancelAnimationFrame(asked);
    watch.disconnect();
    picture.dispose();
  };
}

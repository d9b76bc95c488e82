import { saveFile } from "../../store/page/download";

/** The graph as a picture: its canvases one below the other, on the colour of the panel. */
export function savePng(graph: HTMLElement, name: string): void {
  const canvases = [...graph.querySelectorAll("canvas")].filter(({ width, height }) => width > 0 && height > 0);
  const width = Math.max(0, ...canvases.map((canvas) => canvas.width));
  const picture = document.createElement("canvas");
  picture.width = width;
  picture.height = canvases.reduce((sum, canvas) => sum + canvas.height, 0);
  const context = picture.getContext("2d");
  if (!context || width === 0) return;
  context.fillStyle = getComputedStyle(graph).getPropertyValue("--bg-panel");
  context.fillRect(0, 0, picture.width, picture.height);
  let top = 0;
  for (const canvas of canvases) {
    context.drawImage(canvas, 0, top);
    top += canvas.height;
  }
  picture.toBlob((blob) => blob && saveFile(blob, `${name}.png`), "image/png");
}

/** Scan number and PLC time: they change with every frame, so they are written to the page without React. */

interface Clock {
  scan: number;
  timeNs: number;
}

let now: Clock = { scan: 0, timeNs: 0 };
let painted: Clock | null = null;
const faces = new Set<(clock: Clock) => void>();

export function setClock(scan: number, timeNs: number): void {
  if (now.scan === scan && now.timeNs === timeNs) return;
  if (painted === now) requestAnimationFrame(paint);
  now = { scan, timeNs };
}

export function readClock(): Clock {
  return now;
}

function paint(): void {
  painted = now;
  for (const face of faces) face(now);
}

export function bindClock(face: (clock: Clock) => void): () => void {
  faces.add(face);
  face(now);
  painted ??= now;
  return () => {
    faces.delete(face);
  };
}

/** Import and export of run files: they are large, so the progress is reported, and the transfer can be cancelled. */
import { NoConnection, Refused } from "./rest";
import type { ImportedInstance, Refusal } from "./types";

/** The share that is done, 0 to 1; null while the size is not known. */
type Progress = (share: number | null) => void;

/** The body of an answer, read piece by piece. */
export async function readBody(response: Response, onProgress: Progress): Promise<Blob> {
  const total = Number(response.headers.get("Content-Length") ?? 0);
  const reader = response.body?.getReader();
  if (!reader) return response.blob();
  const parts: BlobPart[] = [];
  let got = 0;
  for (;;) {
    const { done, value } = await reader.read().catch(() => {
      throw new NoConnection(true);
    });
    if (done) return new Blob(parts, { type: "application/octet-stream" });
    parts.push(value);
    got += value.byteLength;
    onProgress(total > 0 ? Math.min(1, got / total) : null);
  }
}

/** Sends a run file: a new instance continues it. Not fetch: only XMLHttpRequest reports how much has been sent. */
export function importRun(
  name: string,
  file: Blob,
  onProgress: Progress,
  signal: AbortSignal,
): Promise<ImportedInstance> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open("POST", `/api/instances/import?${new URLSearchParams({ name })}`);
    request.setRequestHeader("Content-Type", "application/octet-stream");
    request.upload.onprogress = (event) => onProgress(event.lengthComputable ? event.loaded / event.total : null);
    request.onload = () => {
      if (request.status < 300) resolve(JSON.parse(request.responseText) as ImportedInstance);
      else reject(new Refused(request.status, refusalIn(request)));
    };
    request.onerror = () => reject(new NoConnection(false));
    request.onabort = () => reject(new DOMException("given up", "AbortError"));
    signal.addEventListener("abort", () => request.abort());
    request.send(file);
  });
}

function refusalIn(request: XMLHttpRequest): Refusal {
  try {
    const { message, near } = JSON.parse(request.responseText) as Partial<Refusal>;
    if (typeof message === "string") return { message, near: near ?? [] };
  } catch {
    // Not our server's answer: for example the page of a proxy.
  }
  return { message: `${request.status} ${request.statusText}`, near: [] };
}

/** Questions to a worker that searches, each with an end. */
import type { Match, Wanted } from "../../logic/project/search";

export interface FileMatches {
  path: string;
  matches: readonly Match[];
}

export interface Question {
  wanted: Wanted;
  texts: readonly { path: string; text: string }[];
}

/** Longer takes only an expression that tries the same again and again. */
const LIMIT_MS = 2000;

/** Asks one question at a time: null where it took too long, or where the next one came first; its worker is ended then. */
export function searcher(begin: () => Worker): (question: Question) => Promise<FileMatches[] | null> {
  let worker: Worker | null = null;
  let giveUp: (() => void) | null = null;
  return (question) => {
    giveUp?.();
    return new Promise((resolve) => {
      const asked = worker ?? begin();
      worker = asked;
      const end = (found: FileMatches[] | null) => {
        clearTimeout(timer);
        giveUp = null;
        if (found === null) {
          asked.terminate();
          worker = null;
        }
        resolve(found);
      };
      giveUp = () => end(null);
      const timer = setTimeout(giveUp, LIMIT_MS);
      asked.onmessage = ({ data }: MessageEvent<FileMatches[]>) => end(data);
      asked.onerror = giveUp;
      asked.postMessage(question);
    });
  };
}

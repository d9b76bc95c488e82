/** What an idle bench answers over HTTP. */
import type { CheckResult, Instance, ProgramText, WatchList } from "../wire/types";
import { MIKA, MODEL, someApp } from "./samples";

export interface Question {
  method: string;
  /** Below `/api`, with what follows a question mark. */
  path: string;
  body: unknown;
}

/** Makes the answer: an object is sent as JSON, nothing as an empty answer. */
export type Route = (question: Question, match: RegExpExecArray) => unknown;

/** An answer with a status of its own. */
export class Status {
  constructor(
    readonly status: number,
    readonly body: unknown,
  ) {}
}

/** What the server refuses, in its words. */
export const refusal = (message: string, near: string[] = []) => new Status(422, { message, near });

type On = (method: string, path: string, route: Route) => void;

export function usualRoutes(on: On, instance: () => Instance): void {
  const none = () => [];
  on("GET", "", () => someApp(instance()));
  on("GET", "/instances", () => [instance()]);
  on("GET", "/instances/*/model", () => MODEL);
  for (const what of ["symbols", "complete", "traces", "verifications", "comparisons"])
    on("GET", `/instances/*/${what}`, none);
  for (const what of ["files", "sweeps", "states", "records", "trace-records", "watch-lists"])
    on("GET", `/projects/*/${what}`, none);
  on("GET", "/instances/*/program", (): ProgramText => ({ version: 1, files: {}, pous: [] }));
  on("GET", "/instances/*/history/versions", none);
  on("POST", "/projects/*/check", (): CheckResult => ({ checks: [], pous: [], problems: [] }));
  on("POST", "/projects/*/watch-lists", (question) => storedList(question, 1));
  on("PUT", "/watch-lists/*", (question) => storedList(question, versionIn(question) + 1));
}

const versionIn = ({ body }: Question) => (body as { version: number }).version;

/** A list is stored as it was sent. */
function storedList({ body }: Question, version: number): WatchList {
  const list = body as Pick<WatchList, "name" | "shared" | "groups" | "entries">;
  return { ...list, id: 1, version, author: MIKA.name, count: list.entries.length };
}

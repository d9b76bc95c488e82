/** What an idle bench answers over HTTP. */
import type { Instance, WatchList } from "../wire/types";
import type { AnswerOf, BodyOf, Method, PathOf } from "./api";
import { MIKA, MODEL, someApp } from "./samples";

export interface Question<Body = unknown> {
  method: string;
  /** Below `/api`, with what follows a question mark. */
  path: string;
  body: Body;
}

/** Makes the answer: an object is sent as JSON, nothing as an empty answer. */
export type Route<Body = unknown, Answer = unknown> = (
  question: Question<Body>,
  match: RegExpExecArray,
) => Answer | Status | Promise<Answer | Status>;

/** An answer with a status of its own. */
export class Status {
  constructor(
    readonly status: number,
    readonly body: unknown,
  ) {}
}

/** What the server refuses, in its words. */
export const refusal = (message: string, near: string[] = []) => new Status(422, { message, near });

type On = <M extends Method, P extends PathOf<M>>(
  method: M,
  path: P,
  route: Route<BodyOf<M, P>, AnswerOf<M, P>>,
) => void;

export function usualRoutes(on: On, instance: () => Instance): void {
  const none = () => [];
  on("GET", "", () => someApp(instance()));
  on("GET", "/instances", () => [instance()]);
  on("GET", "/instances/*/model", () => MODEL);
  on("GET", "/instances/*/flow", () => ({
    file: "",
    program_version: 1,
    flows: [],
    refused: "",
    first: 1,
    last: 1 << 30,
  }));
  for (const what of [
    "symbols",
    "complete",
    "instances-of",
    "traces",
    "verifications",
    "comparisons",
    "campaigns",
  ] as const)
    on("GET", `/instances/*/${what}`, none);
  for (const what of [
    "files",
    "sweeps",
    "states",
    "records",
    "trace-records",
    "watch-lists",
    "unsaved",
    "drafts",
  ] as const)
    on("GET", `/projects/*/${what}`, none);
  on("GET", "/templates", none);
  on("GET", "/instances/*/program", () => ({ version: 1, files: {}, pous: [] }));
  on("GET", "/instances/*/history/versions", none);
  on("GET", "/projects/*/dialect", () => ({ dialect: "iec" as const }));
  on("GET", "/projects/*/versions", () => []);
  on("GET", "/projects/*/git", () => ({ missing: "", folder: "", branch: "", head: "", elsewhere: [], changes: [] }));
  on("POST", "/projects/*/check", () => ({ checks: [], tasks: [], pous: [], problems: [] }));
  on("POST", "/projects/*/watch-lists", ({ body }) => storedList(body, 1));
  on("PUT", "/watch-lists/*", ({ body }) => storedList(body, body.version + 1));
}

/** A list is stored as it was sent. */
function storedList(list: BodyOf<"POST", "/projects/*/watch-lists">, version: number): WatchList {
  const { groups = [], entries = [] } = list;
  return { ...list, groups, entries, id: 1, version, author: MIKA.name, count: entries.length };
}

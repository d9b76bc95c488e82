/** Disturbances of an instance: the routes of `web/routes/verify.py`. */
import { json } from "./rest";
import type { CommandResult, NewDisturbance } from "./types";

const at = (instance: number) => `/instances/${instance}/disturbances`;

export const disturbances = {
  define: (instance: number, wanted: NewDisturbance) => json<CommandResult>("POST", at(instance), wanted),
  /** Null: all of them. */
  takeBack: (instance: number, id: number | null) =>
    json<CommandResult>("DELETE", id === null ? at(instance) : `${at(instance)}/${id}`),
};

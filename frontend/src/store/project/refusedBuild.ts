/** A refused build, for as long as what it says is true: once the texts have none of its errors any more, it is history. */
import type { Problem } from "../../wire/types";
import { useDocuments } from "./documents";

/** The lines of a text move while it is edited. */
const same = (one: Problem, other: Problem) =>
  one.file === other.file && one.code === other.code && one.message === other.message;

/** True after somebody corrected what a build was refused for. */
export function useCorrected(): boolean {
  return useDocuments(({ build, problems }) => {
    if (build.phase !== "done" || build.ok || build.errors.length === 0) return false;
    return !build.errors.some((error) => problems.some((problem) => same(error, problem)));
  });
}

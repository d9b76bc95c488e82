/** A refused build, for as long as what it says is true: once the texts that it was about have no errors any more, it is history. */
import { create } from "zustand";
import { useDocuments } from "./documents";

/** The last build, and whether the texts had errors since then. */
const useLast = create<{ build: unknown; wrong: boolean }>(() => ({ build: null, wrong: false }));

useDocuments.subscribe(({ build, problems }) => {
  const last = useLast.getState();
  const errors = problems.some(({ severity }) => severity === "error");
  const wrong = errors || (last.build === build && last.wrong);
  if (last.build !== build || last.wrong !== wrong) useLast.setState({ build, wrong });
});

/** True after somebody corrected what a build was refused for. */
export function useCorrected(): boolean {
  const build = useDocuments((documents) => documents.build);
  const errors = useDocuments(({ problems }) => problems.some(({ severity }) => severity === "error"));
  const last = useLast();
  return build.phase === "done" && !build.ok && last.build === build && last.wrong && !errors;
}

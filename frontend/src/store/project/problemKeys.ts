/** Goes from problem to problem, over all files. */
import { openFile } from "../page/navigate";
import { useDocuments } from "./documents";

/** The problem after the caret, or before it; at the end it begins again at the other end. */
export function goToProblem(by: 1 | -1): void {
  const { problems, active, cursor } = useDocuments.getState();
  const here = { file: active ?? "", line: cursor?.line ?? 0, column: cursor?.column ?? 0 };
  const sorted = [...problems].sort(compare);
  const next =
    by === 1 ? sorted.find((each) => compare(each, here) > 0) : sorted.findLast((each) => compare(each, here) < 0);
  const target = next ?? sorted.at(by === 1 ? 0 : -1);
  if (target) openFile(target.file, target.line, target.column);
}

interface Place {
  file: string;
  line: number;
  column: number;
}

const compare = (a: Place, b: Place) => a.file.localeCompare(b.file) || a.line - b.line || a.column - b.column;

import { useEffect, useState } from "react";
import type { CodeAction } from "vscode-languageserver-types";
import { askOf } from "../../../../store/project/language";
import { Icon } from "../../../../ui/Icon";
import type { Problem } from "../../../../wire/types";
import { applyEdits } from "./write";

const MOST = 2;

/** What is wrong with the element at the cursor, and what the language server would do about it. */
export function WrongNote({ path, problem, readOnly }: { path: string; problem: Problem; readOnly: boolean }) {
  const fixes = useFixes(path, problem);
  return (
    <>
      <span className="said bad" role="status">
        <Icon name="error" small />
        <span>{problem.message}</span>
      </span>
      {!readOnly &&
        fixes.slice(0, MOST).map(({ title, edit }) => (
          <button
            key={title}
            type="button"
            className="btn quiet sm"
            // The drawing keeps the focus.
            onPointerDown={(event) => event.preventDefault()}
            onClick={() => applyEdits(path, Object.values(edit?.changes ?? {}).flat())}
          >
            <Icon name="check" small />
            {title}
          </button>
        ))}
    </>
  );
}

function useFixes(path: string, { line, column, end_line, end_column }: Problem): readonly CodeAction[] {
  const [fixes, setFixes] = useState<readonly CodeAction[]>([]);
  useEffect(() => {
    const abort = new AbortController();
    setFixes([]);
    const range = {
      start: { line: line - 1, character: column - 1 },
      end: { line: end_line - 1, character: end_column - 1 },
    };
    askOf<CodeAction[]>("textDocument/codeAction", path, { range, context: { diagnostics: [] } }, abort.signal)
      .then((found) => setFixes((found ?? []).filter(({ edit }) => edit?.changes)))
      // Without a server there are none.
      .catch(() => undefined);
    return () => abort.abort();
  }, [path, line, column, end_line, end_column]);
  return fixes;
}

import { useEffect, useRef } from "react";
import { useDocuments } from "../../../store/project/documents";
import { modelOf } from "./models";
import { editor, endComparison, monospaceFont, nameSides, options } from "./monaco";
import { LANGUAGE } from "./st";

/** The other text on the left, one's own on the right, still editable. */
export default function DiffView({ path, theirs }: { path: string; theirs: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const mine = useDocuments.getState().open[path];
    if (!host.current || !mine) return;
    const original = editor.createModel(theirs, LANGUAGE);
    const view = editor.createDiffEditor(host.current, {
      ...options,
      fontFamily: monospaceFont(),
      originalEditable: false,
      renderSideBySide: true,
      useInlineViewWhenSpaceIsLimited: false,
    });
    const diff = view.createViewModel({ original, modified: modelOf(path, mine.text) });
    view.setModel(diff);
    nameSides(view);
    return () => {
      endComparison(view);
      // Cancels a running comparison, which would access the text that is disposed of now.
      diff.dispose();
      original.dispose();
    };
  }, [path, theirs]);
  return <div ref={host} className="codehost" />;
}

import { useEffect, useRef } from "react";
import { editor, endComparison, monospaceFont, nameSides, options } from "./monaco";
import { LANGUAGE } from "./st";

/** Two texts beside each other, to be read. */
export default function TextsDiff({ before, after }: { before: string; after: string }) {
  const host = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!host.current) return;
    const [original, modified] = [editor.createModel(before, LANGUAGE), editor.createModel(after, LANGUAGE)];
    const view = editor.createDiffEditor(host.current, {
      ...options,
      fontFamily: monospaceFont(),
      originalEditable: false,
      readOnly: true,
      renderSideBySide: true,
      hideUnchangedRegions: { enabled: true },
    });
    const diff = view.createViewModel({ original, modified });
    view.setModel(diff);
    nameSides(view);
    return () => {
      endComparison(view);
      // Cancels a running comparison, which would access the texts that are disposed of now.
      diff.dispose();
      original.dispose();
      modified.dispose();
    };
  }, [before, after]);
  return <div ref={host} className="codehost" />;
}

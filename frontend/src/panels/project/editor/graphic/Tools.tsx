import { memo } from "react";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { t } from "../../../../text";
import { DELETE, INSERTS, keyText, MODES, NAME, NEXT, type Tool } from "./tools";

const toolsOf = (kind: DrawnPart["kind"]): readonly Tool[] => [
  ...INSERTS[kind],
  ...MODES[kind],
  NAME,
  DELETE,
  ...NEXT[kind],
];

interface Props {
  kind: DrawnPart["kind"];
  onPress: (key: string) => void;
}

/** The keys of a drawing as buttons: each does what its key does at the cursor. */
export const Tools = memo(function Tools({ kind, onPress }: Props) {
  return (
    <div className="tools" role="toolbar" aria-label={t("graphic.tools")}>
      {toolsOf(kind).map((tool) => (
        <button
          key={tool.key}
          type="button"
          className="btn quiet sm"
          // The cursor of the drawing stays where the button acts.
          onPointerDown={(event) => event.preventDefault()}
          onClick={() => onPress(tool.key)}
        >
          <kbd>{keyText(tool)}</kbd>
          {t(`graphic.tool.${tool.what}`)}
        </button>
      ))}
    </div>
  );
});

import { memo } from "react";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { type TextKey, t } from "../../../../text";

interface Tool {
  /** As the keyboard is named: what is done is what the key does. */
  key: string;
  shown?: string;
  word: TextKey;
}

const NETWORKS: readonly Tool[] = [
  { key: "Enter", word: "graphic.tool.name" },
  { key: "Delete", shown: "Del", word: "graphic.tool.delete" },
];

const RUNG: readonly Tool[] = [
  { key: "c", word: "graphic.tool.contact" },
  { key: "/", word: "graphic.tool.closed" },
  { key: "w", word: "graphic.tool.below" },
  { key: "o", word: "graphic.tool.coil" },
  { key: "s", word: "graphic.tool.set" },
  { key: "r", word: "graphic.tool.reset" },
  { key: "f", word: "graphic.tool.box" },
  { key: "!", word: "graphic.tool.negate" },
  { key: "e", word: "graphic.tool.edge" },
  ...NETWORKS,
  { key: "Ctrl+I", word: "graphic.tool.rung" },
];

const NETWORK: readonly Tool[] = [
  { key: "f", word: "graphic.tool.box" },
  { key: "a", word: "graphic.tool.assign" },
  { key: "+", word: "graphic.tool.input" },
  { key: "!", word: "graphic.tool.negate" },
  { key: "e", word: "graphic.tool.edge" },
  { key: "j", word: "graphic.tool.jump" },
  ...NETWORKS,
  { key: "Ctrl+I", word: "graphic.tool.network" },
];

const CHART: readonly Tool[] = [
  { key: "s", word: "graphic.tool.step" },
  { key: "a", word: "graphic.tool.action" },
  { key: "v", word: "graphic.tool.alternative" },
  { key: "p", word: "graphic.tool.parallel" },
  { key: "j", word: "graphic.tool.jump" },
  ...NETWORKS,
];

const TOOLS: Record<DrawnPart["kind"], readonly Tool[]> = { rung: RUNG, network: NETWORK, chart: CHART };

interface Props {
  kind: DrawnPart["kind"];
  onPress: (key: string) => void;
}

/** The keys of a drawing as buttons: each does what its key does at the cursor. */
export const Tools = memo(function Tools({ kind, onPress }: Props) {
  return (
    <div className="tools" role="toolbar" aria-label={t("graphic.tools")}>
      {TOOLS[kind].map(({ key, shown, word }) => (
        <button
          key={key}
          type="button"
          className="btn quiet sm"
          // The cursor of the drawing stays where the button acts.
          onPointerDown={(event) => event.preventDefault()}
          onClick={() => onPress(key)}
        >
          <kbd>{shown ?? (key.length === 1 ? key.toUpperCase() : key)}</kbd>
          {t(word)}
        </button>
      ))}
    </div>
  );
});

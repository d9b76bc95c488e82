import type { Apart } from "../../../../logic/graphic/apart";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import { pairText } from "./useApart";

/** Both values of a verification, at an element, a pin or a wire of a drawing. What differed first says so. */
export function ApartMark({ mark, scale }: { mark: Apart; scale: number }) {
  const { x, y, at, power, first, more, control, monitor } = mark;
  const all = [mark, ...more].map(pairText).join("\n");
  return (
    <span
      className={`elemdiff${first ? " first" : ""}${at === "middle" ? " onwire" : ""}`}
      style={{ left: x * scale, top: (at === "middle" ? y - 1 : y + 13) * scale }}
      title={power ? t("graphic.difference.power", { control: control ?? "", monitor: monitor ?? "" }) : all}
    >
      {!power && <Icon name="differs" small />}
      {first && <span className="cause">{`${t("graphic.difference.first")} `}</span>}
      {pairText(mark)}
      {more.length > 0 && ` (+${more.length})`}
    </span>
  );
}

import { useEffect, useState } from "react";
import { grouped } from "../../../../logic/format/numbers";
import { valueIn } from "../../../../logic/graphic/flow";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { type DrawnPart, spotsOf } from "../../../../logic/graphic/sheet";
import { chooseCall, useFlow } from "../../../../store/debug/flow";
import { useSeenAs } from "../../../../store/debug/seenAs";
import { t } from "../../../../text";
import { Icon } from "../../../../ui/Icon";
import type { Flows, Pou } from "../../../../wire/types";
import { sameElement } from "./cursor";
import { follow } from "./follow";
import { flowOfPart, isStill } from "./followFlow";

interface Props {
  path: string;
  part: DrawnPart | undefined;
  place: Place;
  pou: Pou | undefined;
}

/** Where the power of the drawing comes from, and what the element at the cursor saw beside what its variable has now. */
export function FlowNote({ path, part, place, pou }: Props) {
  const flows = useFlow(({ of }) => (pou === undefined ? null : (of.get(pou.name) ?? null)));
  const flow = part ? flowOfPart(part, path, flows) : null;
  const none = useSeenAs(({ instances }) => pou !== undefined && instances.get(pou.name.toUpperCase())?.length === 0);
  if (!flow && none)
    return (
      <span className="row tight" title={t("graphic.noinstance.hint")}>
        <Icon name="info" small />
        {t("graphic.noinstance")}
      </span>
    );
  if (!flow)
    return (
      <span className="row tight" title={t("graphic.fromvalues.hint")}>
        <Icon name="info" small />
        {t("graphic.fromvalues")}
      </span>
    );
  return (
    <>
      <span className="row tight" title={t("graphic.flow.hint")}>
        <Icon name="check" small />
        {t("graphic.flow.scan", { scan: grouped(flow.scan) })}
      </span>
      {pou && flow.calls > 1 && <Calls pou={pou.name} call={flow.call} calls={flow.calls} />}
      {part && pou && flows && <SeenHere path={path} part={part} place={place} pou={pou} flows={flows} />}
    </>
  );
}

/** Which of several calls in the scan is shown. */
function Calls({ pou, call, calls }: { pou: string; call: number; calls: number }) {
  const to = (number: number) => () => chooseCall(pou, number);
  return (
    <span className="row tight">
      <button
        type="button"
        className="btn quiet sm"
        disabled={call <= 1}
        aria-label={t("graphic.flow.earlier")}
        onClick={to(call - 1)}
      >
        <Icon name="back" small />
      </button>
      {t("graphic.flow.call", { call, calls })}
      <button
        type="button"
        className="btn quiet sm"
        disabled={call >= calls}
        aria-label={t("graphic.flow.later")}
        onClick={to(call + 1)}
      >
        <Icon name="chev-r" small />
      </button>
    </span>
  );
}

function SeenHere({ path, part, place, pou, flows }: Required<Props> & { part: DrawnPart; pou: Pou; flows: Flows }) {
  const element = spotsOf(part).find((each) => sameElement(each.place, place))?.element;
  const operand = element && "operand" in element ? String(element.operand) : "";
  const [now, setNow] = useState<string | null>(null);
  useEffect(() => {
    setNow(null);
    if (operand !== "") return follow(pou, [operand], ({ text }) => setNow(text(operand)));
  }, [operand, pou]);
  const seen = flowOfPart(part, path, flows)?.at.get(place.join("."));
  if (operand === "" || !seen) return null;
  const then = valueIn(seen, operand);
  if (then === null) return null;
  return (
    <span className="row tight">
      {isStill() && now !== null
        ? t("graphic.flow.seen.now", { name: operand, value: then, now })
        : t("graphic.flow.seen", { name: operand, value: then })}
    </span>
  );
}

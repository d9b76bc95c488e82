import { hasNodes } from "../../../logic/plc/lines";
import { breakLine } from "../../../store/plc/communication";
import { t } from "../../../text";
import { Segments } from "../../../ui/Segments";
import type { CommunicationFault, LineKind } from "../../../wire/types";

const KINDS = ["none", "silent", "late", "cut", "refused", "node"] as const;
const LATE = [100, 1000, 5000] as const;

/** What is wrong with the line to the clients, or to the plant: takes effect at once, until somebody mends it. */
export function Line({ kind, fault }: { kind: LineKind; fault: CommunicationFault }) {
  const now = fault.kind;
  return (
    <span className="field">
      <span>{t("communication.fault")}</span>
      <span className="row">
        <Segments
          label={t("communication.fault")}
          acts
          value={now}
          options={KINDS.filter((value) => value !== "node" || hasNodes(kind)).map((value) => ({
            value,
            word: t(`communication.fault.${value}`),
            title: t(`communication.fault.${value}.about`),
          }))}
          onChoose={(value) => breakLine(kind, { ...fault, kind: value })}
        />
        {now === "late" && (
          <Segments
            label={t("communication.late")}
            acts
            value={`${fault.late_ms}`}
            options={LATE.map((each) => ({ value: `${each}`, word: `${each} ms` }))}
            onChoose={(value) => breakLine(kind, { kind: "late", late_ms: Number(value) })}
          />
        )}
      </span>
    </span>
  );
}

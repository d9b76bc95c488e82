import { hasNodes, lastsWord } from "../../../logic/plc/lines";
import { breakLine } from "../../../store/plc/communication";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Segments } from "../../../ui/Segments";
import type { CommunicationFault, LineKind } from "../../../wire/types";

const KINDS = ["none", "silent", "late", "cut", "refused", "node"] as const;
const LATE = [100, 1000, 5000] as const;
const LASTS: readonly Lasts[] = [
  { scans: null, period: null },
  { scans: 100, period: null },
  { scans: 100, period: 500 },
];

type Lasts = Pick<CommunicationFault, "scans" | "period">;

/** What is wrong with the line to the clients, or to the plant: takes effect at once, until somebody mends it. */
export function Line({ kind, fault: present }: { kind: LineKind; fault: CommunicationFault }) {
  // One that comes and goes is chosen while it is gone, too.
  const fault = usePlc((plc) => plc.lines.find(({ server }) => server === kind)?.fault) ?? present;
  const now = fault.kind;
  return (
    <span className="field">
      <span>{t("communication.fault")}</span>
      <span className="row comline">
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
            onChoose={(value) => breakLine(kind, { ...fault, late_ms: Number(value) })}
          />
        )}
        {now !== "none" && (
          <Segments
            label={t("communication.lasts")}
            acts
            value={lastsOf(fault)}
            options={LASTS.map(({ scans, period }) => ({
              value: lastsOf({ scans, period }),
              word: lastsWord({ scans, period }),
            }))}
            onChoose={(value) => {
              const chosen = LASTS.find((each) => lastsOf(each) === value);
              breakLine(kind, { ...fault, ...chosen });
            }}
          />
        )}
      </span>
    </span>
  );
}

const lastsOf = ({ scans, period }: Lasts) => `${scans ?? ""}/${period ?? ""}`;

import { useState } from "react";
import { hasNodes, lastsWord } from "../../../logic/plc/lines";
import { breakLine, useCommunication } from "../../../store/plc/communication";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import type { BrokenLine, CommunicationFault, LineKind, ServerKind } from "../../../wire/types";
import "./lines.css";

const KINDS = ["cut", "silent", "refused", "node"] as const;
const LATE = [100, 1000, 5000] as const;
const STAYS = { late_ms: 1000, scans: null, period: null } as const;

/** Faults of the lines between the PLC and clients of its communication unit, or to its plant: a group of its own, as no error memory has them. */
export function Lines({ servers }: { servers: readonly ServerKind[] }) {
  const broken = usePlc((plc) => plc.lines);
  const refused = useCommunication((state) => state.refused);
  const [opened, setOpened] = useState(false);
  const open = opened || broken.length > 0;
  return (
    <section className="lines" aria-label={t("lines.label")}>
      <button type="button" className="head" aria-expanded={open} onClick={() => setOpened(!opened)}>
        <Icon name={open ? "chev-d" : "chev-r"} small />
        <b className="grow">{t("lines.label")}</b>
        <span className="faint">
          {broken.length === 0 ? t("lines.whole") : t("lines.broken", { count: broken.length })}
        </span>
      </button>
      {open && (
        <ul>
          {[...servers, "plant" as const].map((kind) => (
            <Line key={kind} kind={kind} broken={broken.find((each) => each.server === kind)} />
          ))}
        </ul>
      )}
      {open && refused && (
        <p className="st fatal" role="alert">
          {refused.message}
        </p>
      )}
    </section>
  );
}

function Line({ kind, broken }: { kind: LineKind; broken: BrokenLine | undefined }) {
  const forbidden = useForbidden("errors");
  const name = kind === "plant" ? t("communication.plant") : t(`communication.kind.${kind}`);
  const raise = (fault: CommunicationFault) => () => breakLine(kind, fault);
  const items = () => [
    ...KINDS.filter((each) => each !== "node" || hasNodes(kind)).map((each) => ({
      label: t(`communication.fault.${each}`),
      checked: broken?.fault.kind === each,
      onSelect: raise({ ...STAYS, kind: each }),
    })),
    ...LATE.map((late_ms) => ({
      label: t("lines.late", { ms: late_ms }),
      checked: broken?.fault.kind === "late" && broken.fault.late_ms === late_ms,
      onSelect: raise({ ...STAYS, kind: "late", late_ms }),
    })),
  ];
  return (
    <li>
      <span className="grow cut" title={name}>
        {name}
      </span>
      {broken && (
        <StateWord
          tone="generated"
          icon="generated"
          word={faultWord(broken.fault)}
          title={[lastsWord(broken.fault), t("lines.by", { by: broken.by, scan: broken.scan })].join("; ")}
        />
      )}
      {broken && (
        <button
          type="button"
          className="btn sm"
          aria-label={t("lines.mend.of", { name })}
          disabled={forbidden !== null}
          title={forbidden ?? undefined}
          onClick={raise({ ...STAYS, kind: "none" })}
        >
          {t("lines.mend")}
        </button>
      )}
      <MenuButton
        label={t("lines.break.of", { name })}
        title={forbidden ?? undefined}
        className="btn sm"
        disabled={forbidden !== null}
        items={items}
      >
        {t("lines.break")}
      </MenuButton>
    </li>
  );
}

const faultWord = (fault: CommunicationFault) =>
  fault.kind === "late" ? t("lines.late", { ms: fault.late_ms }) : t(`communication.fault.${fault.kind}`);

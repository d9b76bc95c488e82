import { grouped } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { disarm } from "../../../store/errors/simulator";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { StateWord } from "../../../ui/StateWord";
import type { ArmedFault } from "../../../wire/types";

/** Scheduled and recurring faults: what, when next, how often so far, by whom. */
export function ArmedList() {
  const armed = usePlc((plc) => plc.armed);
  const forbidden = useForbidden("errors");
  if (armed.length === 0) return null;
  const locked = { disabled: forbidden !== null, title: forbidden ?? undefined };
  return (
    <section className="armed" aria-label={t("armed.label")}>
      <div className="row">
        <b className="grow">{t("armed.count", { count: armed.length })}</b>
        {armed.length > 1 && (
          <button type="button" className="btn quiet sm" {...locked} onClick={() => void disarm(null)}>
            {t("armed.takeback.all")}
          </button>
        )}
      </div>
      <ul>
        {armed.map((fault) => (
          <Fault key={fault.id} fault={fault} locked={locked} />
        ))}
      </ul>
    </section>
  );
}

function Fault({ fault, locked }: { fault: ArmedFault; locked: { disabled: boolean; title: string | undefined } }) {
  const { byId } = useCatalogue();
  const names = fault.errors.map((id) => byId.get(id)?.name ?? id).join(", ");
  const running = fault.state === "running";
  const facts = [
    fault.raised === 0 ? t("armed.notyet") : t("armed.again", { count: fault.raised }),
    fault.next_scan === null ? "" : t("armed.next", { scan: grouped(fault.next_scan) }),
    t("armed.by", { by: fault.by }),
  ];
  return (
    <li title={`${names}: ${fault.text}`}>
      <StateWord
        tone={running ? "generated" : "recording"}
        icon={running ? "refresh" : "clock"}
        word={t(running ? "armed.running" : "armed.waiting")}
      />
      <span className="grow">
        <p>
          {names} <span className="muted">{fault.text}</span>
        </p>
        <small className="faint">{facts.filter(Boolean).join(" · ")}</small>
      </span>
      <button
        type="button"
        className="btn sm"
        aria-label={t("armed.takeback.of", { errors: names })}
        {...locked}
        onClick={() => void disarm([fault.id])}
      >
        {t("armed.takeback")}
      </button>
    </li>
  );
}

import { useShallow } from "zustand/react/shallow";
import { inNames } from "../../../logic/errors/catalogue";
import { troubles } from "../../../logic/errors/details";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useShape } from "../../../store/errors/shape";
import {
  asksFirst,
  chosenOf,
  entriesOf,
  generate,
  hiddenOf,
  instancesOf,
  recover,
  showAll,
  targets,
  untickHidden,
  useSimulator,
} from "../../../store/errors/simulator";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { WayOn } from "./WayOn";

/** Generates the ticked errors (or the selected one), recovers them, or clears all generated errors. */
export function Actions({ refusedInTree }: { refusedInTree: boolean }) {
  const state = useSimulator(
    useShallow(({ checked, selected, details, outcome, filter, status, severity, reaction }) => ({
      ...{ checked, selected, details, outcome },
      ...{ filter, status, severity, reaction },
    })),
  );
  const shape = useShape();
  const { errors } = useCatalogue();
  const history = usePlc((plc) => plc.errors);
  const forbidden = useForbidden("errors");
  const locked = forbidden !== null;
  const why = forbidden ?? undefined;
  const chosen = chosenOf(state, errors);
  const instances = usePlc((plc) => plc.instances);
  const single = instancesOf(state);
  const count = chosen.length + single.length;
  const raised = targets(state).filter(
    (key) => (instances.get(key) ?? history.get(key))?.status === "generated",
  ).length;
  const any = [...history.values()].some((row) => row.status === "generated");
  const hidden = hiddenOf(state).length;
  const asks = asksFirst(state, errors);
  const unready =
    !asks &&
    (!shape.ready || chosen.some((error) => troubles(error, entriesOf(state, error, history.get(error.id))).size > 0));
  return (
    <>
      {!refusedInTree && <Refusal />}
      <p className="outcome muted" role="status">
        {state.outcome?.ok ? inNames(errors, state.outcome.message, instances) : ""}
      </p>
      {hidden > 0 && <Hidden count={hidden} />}
      <div className="acts">
        <button
          type="button"
          className="btn primary sm"
          disabled={locked || unready || count === 0}
          title={why}
          onClick={() => void generate(errors)}
        >
          <Icon name={shape.plain ? "generated" : "clock"} small />
          {label(count, asks, shape.plain)}
        </button>
        <button
          type="button"
          className="btn sm"
          disabled={locked || raised === 0}
          title={why}
          onClick={() => void recover(false)}
        >
          {raised > 1 ? t("errors.recover.many", { count: raised }) : t("errors.recover")}
        </button>
        <span className="grow" />
        <button
          type="button"
          className="btn quiet sm"
          disabled={locked || !any}
          title={why}
          onClick={() => void recover(true)}
        >
          {t("errors.clearall")}
        </button>
      </div>
    </>
  );
}

/** What is ticked and hidden by a filter is left out: nothing is raised unseen. */
function Hidden({ count }: { count: number }) {
  return (
    <p className="outcome hiddenticks" role="note">
      <Icon name="filter" small />
      <span>
        {t("errors.hidden", { count })}{" "}
        <button type="button" className="link" onClick={showAll}>
          {t("errors.hidden.show")}
        </button>{" "}
        <button type="button" className="link" onClick={untickHidden}>
          {t("errors.hidden.untick")}
        </button>
      </span>
    </p>
  );
}

/** A refusal that is not about a single visible row. */
function Refusal() {
  const outcome = useSimulator((state) => state.outcome);
  const { errors } = useCatalogue();
  if (!outcome || outcome.ok) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        {inNames(errors, outcome.message) || t("notsent.about")} <WayOn outcome={outcome} />
      </span>
    </p>
  );
}

function label(count: number, asks: boolean, plain: boolean): string {
  if (asks) return t("errors.generate.asks", { count });
  if (!plain) return count > 1 ? t("errors.arm.many", { count }) : t("errors.arm");
  return count > 1 ? t("errors.generate.many", { count }) : t("errors.generate");
}

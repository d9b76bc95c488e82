import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { copyName } from "../../../logic/plc/instances";
import { keepState } from "../../../store/errors/sweeps";
import { useBench } from "../../../store/plc/bench";
import { branch, openInstance } from "../../../store/plc/instances";
import { linkWords, scanLink } from "../../../store/plc/links";
import { returnToLive } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { CopyButton } from "../../../ui/CopyButton";
import { Icon } from "../../../ui/Icon";
import type { Instance, InstanceState } from "../../../wire/types";

/** The page shows the past: which scan, who went there, and the two ways to continue. */
export function PastBanner({ state }: { state: InstanceState }) {
  const instance = useBench((bench) => bench.instance);
  const [asking, setAsking] = useState<{ instance: Instance; scan: number } | null>(null);
  const { past, scan } = state;
  if (!past) return null;
  return (
    <section className="banner past" aria-label={t("past.label")}>
      <Icon name="past" />
      <span className="grow">
        <b>{t("past.title", { scan: grouped(scan), live: grouped(past.live_scan) })}</b> {t("past.by", { by: past.by })}{" "}
        <span className="muted">{t("past.readonly")}</span>
      </span>
      <button
        type="button"
        className="btn sm"
        disabled={instance === null}
        onClick={() => instance && setAsking({ instance, scan })}
      >
        <Icon name="branch" small />
        {t("past.branch")}
      </button>
      <button
        type="button"
        className="btn sm"
        disabled={instance === null}
        title={t("states.keep.hint")}
        onClick={() => keepState(scan)}
      >
        <Icon name="plus" small />
        {t("states.keep")}
      </button>
      <CopyButton label={t("link.copy")} {...linkWords()} text={() => scanLink(scan)} disabled={instance === null} />
      <button type="button" className="btn past sm" onClick={returnToLive}>
        {t("past.live")}
      </button>
      {asking && <BranchHere {...asking} onClose={() => setAsking(null)} />}
    </section>
  );
}

function BranchHere({ instance, scan, onClose }: { instance: Instance; scan: number; onClose: () => void }) {
  const taken = useBench((bench) => bench.app?.instances ?? []).map(({ name }) => name);
  return (
    <AskName
      title={t("instances.branch.at", { name: instance.name, scan: grouped(scan) })}
      about={t("instances.branch.about", { name: instance.name })}
      label={t("instances.name")}
      action={t("create")}
      initial={copyName(instance.name, taken)}
      onName={async (name) => openInstance(await branch(instance, name, scan))}
      onClose={onClose}
    />
  );
}

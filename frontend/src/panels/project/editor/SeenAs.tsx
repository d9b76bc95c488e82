import { useEffect } from "react";
import { choose, loadInstances, seenAs, useSeenAs } from "../../../store/debug/seenAs";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";

/** Chooses the instance whose values are shown in the text of a block. */
export function SeenAs({ pou }: { pou: string }) {
  const instance = useSeenAs((seen) => seenAs(seen, pou));
  const all = useSeenAs((seen) => seen.instances.get(pou.toUpperCase()));
  const version = usePlc((plc) => plc.state?.program_version);
  const runs = usePlc((plc) => plc.state !== null && plc.state.state !== "off");
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different program has different instances
  useEffect(() => {
    if (runs) void loadInstances(pou);
  }, [pou, version, runs]);
  if (all?.length === 0) return <span className="faint cut">{t("debug.seenas.none")}</span>;
  if (instance === undefined || !all) return null;
  if (all.length === 1 && instance === pou) return null;
  return (
    <>
      <span className="faint seenasof">{t("debug.seenas")}</span>
      <MenuButton
        label={t("debug.seenas.label", { pou, instance })}
        className="btn quiet sm seenas"
        items={() =>
          all.map((path) => ({ label: path, checked: path === instance, onSelect: () => choose(pou, path) }))
        }
      >
        <span className="mono cut">{instance}</span>
        <Icon name="chev-d" small />
      </MenuButton>
    </>
  );
}

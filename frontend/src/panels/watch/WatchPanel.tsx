import { type DragEvent, useMemo, useState } from "react";
import { pathsIn } from "../../logic/paths";
import { t } from "../../logic/text";
import { watchRows } from "../../logic/watchrows";
import { useForces } from "../../store/forces";
import { useMembers } from "../../store/members";
import { useForbidden, usePlc } from "../../store/plc";
import { useWatches } from "../../store/watches";
import { addToWatch, releaseForce, useWatchList } from "../../store/watchlist";
import { Icon } from "../../ui/Icon";
import { MenuButton, type MenuItem } from "../../ui/Menu";
import { AddBox } from "./AddBox";
import { EmptyWatch } from "./EmptyWatch";
import { WatchGrid } from "./WatchGrid";

/** The watch table: live values, and the place where values are changed and forced. */
export function WatchPanel() {
  const list = useWatchList();
  const members = useMembers((state) => state.of);
  const symbols = useWatches((state) => state.symbols);
  const refusals = useWatches((state) => state.refusals);
  const [over, setOver] = useState(false);
  const rows = useMemo(
    () => watchRows({ roots: list.roots, open: list.open, notes: list.notes, members, symbols, refusals }),
    [list.roots, list.open, list.notes, members, symbols, refusals],
  );

  function onDrop(event: DragEvent): void {
    event.preventDefault();
    setOver(false);
    const paths = pathsIn(event.dataTransfer.getData("text/plain"));
    if (paths.length > 0) addToWatch(paths);
  }

  return (
    <div
      className={`pane flexcol${over ? " dropping" : ""}`}
      data-pane="watch"
      data-live
      onDragOver={(event) => {
        if (!event.dataTransfer.types.includes("text/plain")) return;
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={onDrop}
    >
      <div className="sub">
        <AddBox />
        <span className="grow" />
        <ForceCount />
      </div>
      {list.roots.length === 0 ? <EmptyWatch /> : <WatchGrid rows={rows} />}
    </div>
  );
}

/** Every force that holds, each to be released, or all at once. */
function ForceCount() {
  const count = usePlc((plc) => plc.state?.forces ?? 0);
  const held = useForces((forces) => forces.held);
  const locked = useForbidden("force");
  if (count === 0) return null;
  return (
    <MenuButton
      label={t("force.count", { count })}
      items={() => [
        ...[...held.values()].map(
          ({ path, value, author }): MenuItem => ({
            label: t("force.release.menu", { path, value }),
            icon: "unforce",
            hint: locked ?? author,
            disabled: locked !== null,
            onSelect: () => void releaseForce(path),
          }),
        ),
        {
          label: t("force.releaseall"),
          icon: "unforce",
          separated: true,
          disabled: locked !== null,
          onSelect: () => void releaseForce(null),
        },
      ]}
    >
      <span className="st forced">
        <Icon name="forced" small />
        {t("force.count", { count })}
      </span>
    </MenuButton>
  );
}

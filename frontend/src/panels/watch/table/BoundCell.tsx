import { chosenFor } from "../../../logic/format/paths";
import { actualOf, type ValueRow } from "../../../logic/watch/watchrows";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useBindings } from "../../../store/watch/bindings";
import { useForcedAt, useForceValues } from "../../../store/watch/forces";
import { useWatchList } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { PlcSymbol } from "../../../wire/types";
import { siteShown } from "./sites";

/** The context of the row: the argument of an in-out, the program's value under a force, the error of a flag. */
export function BoundCell({ row, symbol }: { row: ValueRow; symbol: PlcSymbol | null }) {
  const forced = useForcedAt(row.path);
  const did = useForceValues((values) => (forced ? values.of.get(forced.path) : undefined));
  const { errors } = useCatalogue();
  if (row.inOut !== null) return <Actual path={row.path} inOut={row.inOut} />;
  const wanted = did?.after_program ?? forced?.after_program;
  const flag = symbol?.address ? errors.find(({ flag }) => flag === symbol.address)?.name : undefined;
  const says = wanted ? t("force.programwrites", { value: wanted }) : flag;
  return (
    <span className="bound" role="gridcell" title={says}>
      {says && <span className="ui cut">{says}</span>}
    </span>
  );
}

function Actual({ path, inOut }: { path: string; inOut: string }) {
  const binding = useBindings((bindings) => bindings.of.get(inOut));
  const chosen = useWatchList((list) => chosenFor(list.sites, inOut));
  const site = binding && siteShown(binding, chosen);
  if (!binding || !site?.actual) {
    return (
      <span className="bound" role="gridcell" title={binding?.message}>
        {binding && <span className="ui cut">{t("binding.none")}</span>}
      </span>
    );
  }
  const actual = actualOf(path, inOut, site.actual);
  const shown = path === inOut && site.address ? `${actual} (${site.address})` : actual;
  return (
    <span className="bound" role="gridcell" title={shown}>
      <Icon name="bound" />
      <span className="cut">{shown}</span>
    </span>
  );
}

/** The address of the value; for an in-out, the address of the variable that was passed. */
export function AddressCell({ row, symbol }: { row: ValueRow; symbol: PlcSymbol | null }) {
  const binding = useBindings((bindings) => (row.inOut === row.path ? bindings.of.get(row.path) : undefined));
  const chosen = useWatchList((list) => chosenFor(list.sites, row.path));
  const address = symbol?.address ?? ((binding && siteShown(binding, chosen)?.address) || null);
  return (
    <span className="mono muted" role="gridcell" title={address ?? undefined}>
      {symbol ? (address ?? "–") : ""}
    </span>
  );
}

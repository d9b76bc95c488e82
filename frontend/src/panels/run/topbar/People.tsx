import { useState } from "react";
import { useBench } from "../../../store/plc/bench";
import { usePlc } from "../../../store/plc/plc";
import { follow, goTo, othersOf, usePeople } from "../../../store/project/people";
import { t } from "../../../text";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import type { Person } from "../../../wire/types";
import { ChangeName } from "./ChangeName";
import { Invite } from "./Invite";
import "./people.css";

/** Who is here, and a menu: where the others are, how to follow one, how to invite somebody. */
export function People() {
  const present = usePlc((plc) => plc.users);
  const you = usePlc((plc) => plc.you);
  const known = usePeople();
  const [asking, setAsking] = useState<"invite" | "name" | null>(null);
  // A person with two windows counts once, and a client of a protocol is no person: the Communication page has those.
  const users = [...new Map(present.filter(({ client }) => !client).map((user) => [user.name, user])).values()];
  const others = users.filter((user) => user.name !== you?.name);
  const names = others.map((user) => user.name).join(", ");
  const items = (): MenuItem[] => [
    ...othersOf(known).flatMap(itemsOf),
    { label: t("invite.menu"), icon: "link", separated: true, onSelect: () => setAsking("invite") },
    { label: t("name.menu"), icon: "users", onSelect: () => setAsking("name") },
  ];
  return (
    <>
      <ul className="people" aria-label={t("people.here")}>
        {users.map((user) => {
          const me = user.name === you?.name;
          const look = `avatar person${known.people.find(({ name }) => name === user.name)?.colour ?? 0}`;
          if (!me)
            return (
              <li key={user.name} className={look} title={user.name}>
                {user.initials}
              </li>
            );
          return (
            <li key={user.name}>
              <MenuButton
                label={t("people.menu", user)}
                title={t("people.you", user)}
                className={`${look} me`}
                items={items}
              >
                {user.initials}
              </MenuButton>
            </li>
          );
        })}
        {others.length > 0 && (
          <li className="avatar more" title={t("people.more", { count: others.length, names })} aria-hidden="true">
            {`+${others.length}`}
          </li>
        )}
      </ul>
      {asking === "invite" && <Invite onClose={() => setAsking(null)} />}
      {asking === "name" && <ChangeName name={you?.name ?? ""} onClose={() => setAsking(null)} />}
    </>
  );
}

function itemsOf(person: Person): MenuItem[] {
  const { name, id } = person;
  const place = placeOf(person);
  return [
    { label: t("people.goto", { name, place }), icon: "moved", onSelect: () => void goTo(person) },
    { label: t("people.follow", { name }), icon: "eye", onSelect: () => follow(id) },
  ];
}

/** The file and line, the PLC if it is not the one that is shown, and the scan while that shows its past. */
function placeOf({ file, line, instance }: Person): string {
  const { app, instance: shown } = useBench.getState();
  const { state } = usePlc.getState();
  const parts = [file ? t("people.at", { file, line: line ?? 1 }) : t("people.nofile")];
  if (instance !== shown?.id) {
    const name = app?.instances.find((each) => each.id === instance)?.name;
    if (name) parts.push(name);
  } else if (state?.past) parts.push(t("people.past", { scan: state.scan }));
  return parts.join(" \u00b7 ");
}

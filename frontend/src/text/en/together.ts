/** English: people at one project. */
export const together = {
  "follow.about": "You see what they see. Any key, click or scroll of your own ends it.",
  "follow.end": "Stop following",
  "follow.label": "Following somebody",
  "follow.title": "You follow {name}.",
  "invite.about":
    "Whoever opens this address can do everything that you can do on this server: see and change all projects, write to all PLCs, delete. Give it only to people you trust.",
  "invite.address": "Address with the token",
  "invite.copy": "Copy the address",
  "invite.menu": "Invite…",
  "invite.own":
    "{host} means a different computer on every computer. Open this page by the name or the address of the server's computer first, then invite.",
  "invite.title": "Invite somebody",
  "name.about":
    "Others see it at your caret, in lists and in the history. Your own watch lists belong to your name: with a new one you begin new ones. This browser keeps it.",
  "name.ask": "Others see you as {name}.",
  "name.ask.about": "What is your name? It is shown at your caret and beside what you do.",
  "name.label": "Your name",
  "name.menu": "Change your name…",
  "name.stay": "Stay {name}",
  "name.title": "Your name",
  "name.use": "Use this name",
  "people.at": "{file}, line {line}",
  "people.follow": "Follow {name}",
  "people.goto": "{name}: {place}",
  "people.menu": "People. You are {name}: where the others are, follow, invite, change your name",
  "people.nofile": "in no file",
  "people.past": "past, scan {scan}",
};

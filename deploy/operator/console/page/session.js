// SPDX-License-Identifier: Apache-2.0
// Who is signed in: by a token in the page's form, or behind '#token=' of its address, from where it is
// taken away at once. The token is kept nowhere.

export async function ask_session() {
  const answer = await fetch("/session", { headers: { Accept: "application/json" } });
  if (!answer.ok) throw new Error(`the console answers ${answer.status}`);
  return answer.json();
}

export function token_of_address() {
  const found = /[#&]token=([^&]+)/.exec(location.hash);
  if (!found) return null;
  history.replaceState(null, "", location.pathname + location.search);
  return decodeURIComponent(found[1]);
}

// Null where it is taken, else why not, in words.
export async function sign_in(token) {
  const answer = await fetch("/session", {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ token }),
  });
  if (answer.ok) return null;
  const said = await answer.json().catch(() => ({}));
  if (answer.status === 429) return said.error ?? "too many wrong tokens: wait a little";
  return said.error ?? `the console answers ${answer.status}`;
}

export async function sign_out() {
  await fetch("/session", { method: "DELETE" });
}

// The whole address that a viewer is given.
export async function view_address() {
  const answer = await fetch("/ticket", { method: "POST" });
  if (!answer.ok) throw new Error(`the console answers ${answer.status}`);
  const { path } = await answer.json();
  return `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}${path}`;
}

// Resolves with the session once somebody is signed in.
export async function signed_in_session(page) {
  let error = null;
  const token = token_of_address();
  if (token) error = await sign_in(token);
  let session = await ask_session();
  if (session.scope && !error) return session;
  page.section.hidden = false;
  page.error.textContent = error ?? "";
  page.field.focus();
  for (;;) {
    await new Promise((resolve) => {
      page.form.onsubmit = (event) => {
        event.preventDefault();
        resolve();
      };
    });
    const why = await sign_in(page.field.value.trim()).catch(() => "the console does not answer");
    page.error.textContent = why ?? "";
    if (why) continue;
    page.field.value = "";
    session = await ask_session();
    if (session.scope) break;
  }
  page.section.hidden = true;
  return session;
}

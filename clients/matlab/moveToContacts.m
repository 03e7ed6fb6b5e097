function moveToContacts()
%MOVETOCONTACTS  moveToContacts()   Moves the current hand along its approach direction until the first contact, at most 30 mm.
  graspitServer('send', 'moveToContacts');
  getRobotName();  % moveToContacts has no reply; its error would be the reply to this
end
